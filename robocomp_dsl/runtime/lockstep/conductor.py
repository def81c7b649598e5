"""The source's side of lock-step: who takes part, who is due, and who was lost.

In: names of components, ticks. Out: their computes, one after the other in the order of their
names. One that ends or does not answer is told, and left out until it is back, or ends the source.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass

from robocomp_dsl.runtime.clock import NANO
from robocomp_dsl.runtime.clock_interface import FOLLOWER, FollowerProxy, Hearer, Tick
from robocomp_dsl.runtime.clock_settings import ClockSettings
from robocomp_dsl.runtime.errors import MiddlewareError, NoServer
from robocomp_dsl.runtime.lockstep.follower import NOTHING
from robocomp_dsl.runtime.lockstep.ports import StepPorts
from robocomp_dsl.runtime.middleware.base import Endpoint, Middleware

PORT = "Follower"
START_S = 60.0
"""How long the source waits for components that have not been there yet."""
TELL_S = 5.0
"""After this time it tells for whom it waits."""
AGAIN_S = 1.0
"""How often it looks for one that was lost."""
GLANCE_S = 0.2

log = logging.getLogger("robocomp")


@dataclass(slots=True)
class Member:
    """One component. `next` in ns; `lost`: the wall clock when it was last looked for, or 0."""

    name: str
    proxy: FollowerProxy
    next: int = 0
    restless: bool = False
    lost: float = 0.0
    hearers: tuple[Hearer, ...] = ()


class Conductor:
    """`clock_source.Steps` over a middleware. `give_up` ends the source, with a reason."""

    def __init__(
        self,
        middleware: Middleware,
        name: str,
        settings: ClockSettings,
        ports: StepPorts,
        give_up: Callable[[str], None],
    ) -> None:
        self._settings = settings
        self._ports = ports
        self._give_up = give_up
        self._epoch = 0
        self._members = []
        for member in sorted(set(settings.members) - {name}):
            at = Endpoint(FOLLOWER, name, f"{PORT} {member}", (member,))
            proxy = FollowerProxy(middleware.proxy(at))
            proxy.set_timeout(settings.limit)
            self._members.append(Member(member, proxy))

    def leave(self, name: str) -> None:
        """One ends in order."""
        for one in self._members:
            if one.name == name and not one.lost:
                one.lost = time.monotonic()
                log.info("%s has ended, the others go on without it", name)

    def meet(self, over: Callable[[], bool]) -> None:
        """See `Steps`."""
        until = time.monotonic() + START_S
        told = False
        waiting = self._members
        while waiting and not over() and time.monotonic() < until:
            waiting = [one for one in waiting if not one.proxy.wait_for_server(GLANCE_S)]
            if waiting and not told and time.monotonic() > until - START_S + TELL_S:
                told = True
                log.info("time begins when %s is there", " and ".join(m.name for m in waiting))
        if over():
            return
        for one in waiting:
            self._lose(one, 0, NoServer(f"{one.name} was not there within {START_S:g} s"))
        for one in self._there():
            self._ask(one, 0, self._introduce)
        self._introduce_all()
        log.info("in lock-step with %s", ", ".join(m.name for m in self._there()) or "nobody")

    def _introduce(self, one: Member) -> None:
        one.hearers = tuple(one.proxy.introduce())

    def _introduce_all(self) -> None:
        everyone = [*self._ports.hearers, *(h for one in self._there() for h in one.hearers)]
        self._ports.meet(everyone)
        for one in self._there():
            self._ask(one, 0, lambda m: m.proxy.meet(everyone))

    def _there(self) -> list[Member]:
        return [one for one in self._members if not one.lost]

    def next(self) -> int | None:
        """See `Steps`."""
        return min((one.next for one in self._there() if one.next != NOTHING), default=None)

    def run(self, tick: Tick) -> None:
        """See `Steps`."""
        anew, self._epoch = tick.epoch != self._epoch, tick.epoch
        self._look_for_lost(tick)
        for one in self._there():
            if anew or one.restless or NOTHING != one.next <= tick.time:
                self._ask(one, tick.time, lambda m: self._advance(m, tick))

    def _advance(self, one: Member, tick: Tick) -> None:
        due = one.proxy.advance(tick)
        # One that answers that it is still due would hold time for ever.
        one.next = due.time if due.time == NOTHING else max(due.time, tick.time + 1)
        one.restless = due.restless

    def _ask(self, one: Member, ns: int, question: Callable[[Member], None]) -> None:
        try:
            question(one)
        except MiddlewareError as error:
            self._lose(one, ns, error)

    def _lose(self, one: Member, ns: int, error: MiddlewareError) -> None:
        if one.lost:
            return
        one.lost = time.monotonic()
        said = f"{one.name} was lost at {ns / NANO:g} s of simulated time: {error}"
        if self._settings.stops:
            self._give_up(said)
        else:
            log.warning("%s; the others go on without it", said)

    def _look_for_lost(self, tick: Tick) -> None:
        now = time.monotonic()
        for one in self._members:
            if one.lost and now - one.lost > AGAIN_S:
                one.lost = now
                if one.proxy.wait_for_server(0.0) and self._is_back(one):
                    one.lost, one.next = 0.0, tick.time
                    self._introduce_all()
                    log.info("%s is back at %g s of simulated time", one.name, tick.time / NANO)

    def _is_back(self, one: Member) -> bool:
        one.proxy.set_timeout(GLANCE_S)
        try:
            self._introduce(one)
        except MiddlewareError:
            return False
        finally:
            one.proxy.set_timeout(self._settings.limit)
        return True
