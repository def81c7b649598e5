"""By which clock one component lives, and what its ports need for it.

In: its settings, what it is, its connections. Out: a `Timing`. The component that publishes
`RoboCompClock::Clock` makes the time of a deployment, all others follow it.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from robocomp_dsl.runtime.clock import Clock, WallClock
from robocomp_dsl.runtime.clock_interface import (
    CLOCK,
    FOLLOWER,
    LEADER,
    ClockProxy,
    LeaderProxy,
    Tick,
)
from robocomp_dsl.runtime.clock_settings import LOCKSTEP, WALL, ClockSettings
from robocomp_dsl.runtime.clock_source import ClockSource
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.lockstep.conductor import PORT, Conductor
from robocomp_dsl.runtime.lockstep.follower import Follower
from robocomp_dsl.runtime.lockstep.ports import StepPorts
from robocomp_dsl.runtime.middleware.base import Endpoint, Middleware, Qos
from robocomp_dsl.runtime.simulated_clock import SimulatedClock
from robocomp_dsl.runtime.spec import ComponentSpec

LEADING = "Leader"
LEAVE_S = 2.0
"""What telling the source of the own end may take."""


def _nothing() -> None:
    pass


@dataclass(frozen=True, slots=True)
class Timing:
    """`ports` is the middleware for the component's own ports.

    `open` is called behind them, `close` behind `finalize`.
    """

    clock: Clock
    ports: Middleware
    open: Callable[[], None] = _nothing
    close: Callable[[], None] = _nothing


@dataclass(frozen=True, slots=True)
class Owner:
    """Whose timing it is. `fail` ends it as failed; `restless`: see `Due` in LockStep.idsl."""

    name: str
    spec: ComponentSpec
    fail: Callable[[str], None]
    restless: Callable[[], bool]


def timing_of(settings: ClockSettings, owner: Owner, middleware: Middleware) -> Timing:
    """See the module."""
    if settings.kind == WALL:
        return Timing(WallClock(), middleware)
    port = next((p for p in owner.spec.publishes if p.proxy.INTERFACE.name == CLOCK.name), None)
    if port is not None and settings.source in ("", owner.name):
        return _source(settings, owner, middleware, port.name)
    if settings.kind == LOCKSTEP:
        return _follower(settings, owner, middleware)
    return _listener(settings, owner, middleware)


def _source(settings: ClockSettings, owner: Owner, middleware: Middleware, port: str) -> Timing:
    told = ClockProxy(middleware.advertise(Endpoint(CLOCK, owner.name, port)))

    def tell(tick: Tick) -> None:
        if told.is_heard():
            told.tick(tick)

    if settings.kind != LOCKSTEP:
        return Timing(ClockSource(tell), middleware)

    def now() -> int:
        return source.nanoseconds

    ports = StepPorts(middleware, settings.limit, now, lambda _ns: None)
    steps = Conductor(middleware, owner.name, settings, ports, owner.fail)
    source = ClockSource(tell, steps)

    def serve() -> None:
        at = Endpoint(LEADER, owner.name, LEADING)
        middleware.serve(at, {"leave": steps.leave}, Execution())

    return Timing(source, ports, serve)


def _follower(settings: ClockSettings, owner: Owner, middleware: Middleware) -> Timing:
    follower = Follower(settings.limit, owner.restless)

    def now() -> int:
        return follower.nanoseconds

    ports = StepPorts(middleware, settings.limit, now, follower.reach)

    def serve() -> None:
        at = Endpoint(FOLLOWER, owner.name, PORT)
        middleware.serve(at, follower.handlers(ports), Execution())

    peers = (settings.source,) if settings.source else ()
    leader = LeaderProxy(middleware.proxy(Endpoint(LEADER, owner.name, LEADING, peers)))
    leader.set_timeout(LEAVE_S)

    def leave() -> None:
        # Where the source has ended already nobody will miss this component.
        with suppress(MiddlewareError):
            leader.leave(owner.name)

    return Timing(follower, ports, serve, leave)


def _listener(settings: ClockSettings, owner: Owner, middleware: Middleware) -> Timing:
    clock = SimulatedClock()
    peers = (settings.source,) if settings.source else ()

    def hear(t: Tick) -> None:
        clock.hear(t)

    def subscribe() -> None:
        at = Endpoint(CLOCK, owner.name, "Clock of the deployment", peers, Qos(depth=1))
        middleware.subscribe(at, {"tick": hear}, Execution())

    return Timing(clock, middleware, subscribe)
