"""Creates the clock of a component, and the ports that the clock needs.

In: the clock settings, the component, its middleware. Out: a `ClockBinding`. The component that
publishes `RoboCompClock::Clock` is the clock source of the deployment; all others follow it.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from robocomp_dsl.runtime.clock import Clock, WallClock
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.spec import ComponentSpec
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import Ports
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.time.clock_interface import (
    CLOCK,
    FOLLOWER,
    LEADER,
    ClockProxy,
    LeaderProxy,
    Tick,
)
from robocomp_dsl.runtime.time.clock_settings import LOCKSTEP, WALL, ClockSettings
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.runtime.time.lockstep.coordinator import FOLLOWER_PORT, LockstepCoordinator
from robocomp_dsl.runtime.time.lockstep.follower import LockstepClock
from robocomp_dsl.runtime.time.lockstep.ports import LockstepPorts
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock

LEADER_PORT = "Leader"
LEAVE_TIMEOUT_S = 2.0
"""Time limit for telling the clock source that this component stops."""


def _nothing() -> None:
    pass


@dataclass(frozen=True, slots=True)
class ClockBinding:
    """A clock, and the middleware for the component's own ports.

    `open` is called after its ports were opened, `close` after `finalize`.
    """

    clock: Clock
    ports: Ports
    open: Callable[[], None] = _nothing
    close: Callable[[], None] = _nothing


@dataclass(frozen=True, slots=True)
class ComponentHandle:
    """The component of a clock. `fail` stops it as failed; `is_event_driven`: see LockStep.idsl."""

    name: str
    spec: ComponentSpec
    fail: Callable[[str], None]
    is_event_driven: Callable[[], bool]


def create_clock(
    settings: ClockSettings, owner: ComponentHandle, middleware: Ports
) -> ClockBinding:
    """The clock that `settings` select for the component `owner`."""
    if settings.kind == WALL:
        return ClockBinding(WallClock(), middleware)
    port = next((p for p in owner.spec.publishes if p.proxy.INTERFACE.name == CLOCK.name), None)
    if port is not None and settings.source in ("", owner.name):
        return _bind_source(settings, owner, middleware, port.name)
    if settings.kind == LOCKSTEP:
        return _bind_lockstep(settings, owner, middleware)
    return _bind_simulated(settings, owner, middleware)


def _bind_source(
    settings: ClockSettings, owner: ComponentHandle, middleware: Ports, port: str
) -> ClockBinding:
    proxy = ClockProxy(middleware.advertise(Endpoint(CLOCK, owner.name, port)))

    def publish(tick: Tick) -> None:
        if proxy.has_subscribers():
            proxy.tick(tick)

    if settings.kind != LOCKSTEP:
        return ClockBinding(ClockSource(publish), middleware)

    def now() -> int:
        return source.nanoseconds

    ports = LockstepPorts(middleware, settings.limit, now, lambda _ns: None)
    coordinator = LockstepCoordinator(middleware, owner.name, settings, ports, owner.fail)
    source = ClockSource(publish, coordinator)

    def serve() -> None:
        at = Endpoint(LEADER, owner.name, LEADER_PORT)
        middleware.serve(at, {"leave": coordinator.leave}, CallbackGroup())

    return ClockBinding(source, ports, serve)


def _bind_lockstep(
    settings: ClockSettings, owner: ComponentHandle, middleware: Ports
) -> ClockBinding:
    follower = LockstepClock(settings.limit, owner.is_event_driven)

    def now() -> int:
        return follower.nanoseconds

    ports = LockstepPorts(middleware, settings.limit, now, follower.set_time)

    def serve() -> None:
        at = Endpoint(FOLLOWER, owner.name, FOLLOWER_PORT)
        middleware.serve(at, follower.handlers(ports), CallbackGroup())

    peers = (settings.source,) if settings.source else ()
    leader = LeaderProxy(middleware.proxy(Endpoint(LEADER, owner.name, LEADER_PORT, peers)))
    leader.set_timeout(LEAVE_TIMEOUT_S)

    def leave() -> None:
        # A source that has already exited does not wait for this component.
        with suppress(MiddlewareError):
            leader.leave(owner.name)

    return ClockBinding(follower, ports, serve, leave)


def _bind_simulated(
    settings: ClockSettings, owner: ComponentHandle, middleware: Ports
) -> ClockBinding:
    clock = SimulatedClock()
    peers = (settings.source,) if settings.source else ()

    def on_tick(t: Tick) -> None:
        clock.on_tick(t)

    def subscribe() -> None:
        at = Endpoint(CLOCK, owner.name, "Clock of the deployment", peers, Qos(depth=1))
        middleware.subscribe(at, {"tick": on_tick}, CallbackGroup())

    return ClockBinding(clock, middleware, subscribe)
