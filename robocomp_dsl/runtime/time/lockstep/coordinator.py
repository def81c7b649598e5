"""The clock source's side of lock-step: finds members, runs due members, drops lost members.

In: names of components, ticks. Out: their computes, one after the other in the order of their
names. A member that disconnects or times out is logged and dropped until it rejoins, or stops the
source.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass

from robocomp_dsl.runtime.clock import NANO
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import Ports
from robocomp_dsl.runtime.errors import MiddlewareError, NoServer
from robocomp_dsl.runtime.time.clock_interface import FOLLOWER, FollowerProxy, Hearer, Tick
from robocomp_dsl.runtime.time.clock_settings import ClockSettings
from robocomp_dsl.runtime.time.lockstep.follower import NEVER
from robocomp_dsl.runtime.time.lockstep.ports import LockstepPorts

FOLLOWER_PORT = "Follower"
START_TIMEOUT_S = 60.0
"""How long the source waits for all members at the start."""
LOG_WAITING_AFTER_S = 5.0
"""After this time it logs for which members it waits."""
REJOIN_PERIOD_S = 1.0
"""Period in which it probes lost members."""
PROBE_TIMEOUT_S = 0.2

log = logging.getLogger("robocomp")


@dataclass(slots=True)
class LockstepMember:
    """One component. `next_due` in ns; `lost_since`: wall time of the last probe, 0: not lost."""

    name: str
    proxy: FollowerProxy
    next_due: int = 0
    is_event_driven: bool = False
    lost_since: float = 0.0
    subscribers: tuple[Hearer, ...] = ()


class LockstepCoordinator:
    """A `StepCoordinator` over a middleware. `fail` stops the source, with a reason."""

    def __init__(
        self,
        middleware: Ports,
        name: str,
        settings: ClockSettings,
        ports: LockstepPorts,
        fail: Callable[[str], None],
    ) -> None:
        self._settings = settings
        self._ports = ports
        self._fail = fail
        self._resets = 0
        self._members = []
        for member in sorted(set(settings.members) - {name}):
            at = Endpoint(FOLLOWER, name, f"{FOLLOWER_PORT} {member}", (member,))
            proxy = FollowerProxy(middleware.proxy(at))
            proxy.set_timeout(settings.limit)
            self._members.append(LockstepMember(member, proxy))

    def leave(self, name: str) -> None:
        """A member stops normally."""
        for member in self._members:
            if member.name == name and not member.lost_since:
                member.lost_since = time.monotonic()
                log.info("%s stopped; the others continue", name)

    def connect(self, over: Callable[[], bool]) -> None:
        """See `StepCoordinator`."""
        until = time.monotonic() + START_TIMEOUT_S
        logged = False
        waiting = self._members
        while waiting and not over() and time.monotonic() < until:
            waiting = [
                absent for absent in waiting if not absent.proxy.wait_for_server(PROBE_TIMEOUT_S)
            ]
            if (
                waiting
                and not logged
                and time.monotonic() > until - START_TIMEOUT_S + LOG_WAITING_AFTER_S
            ):
                logged = True
                log.info(
                    "waiting for %s before simulated time starts",
                    " and ".join(m.name for m in waiting),
                )
        if over():
            return
        for absent in waiting:
            self._drop(
                absent, 0, NoServer(f"{absent.name} did not appear within {START_TIMEOUT_S:g} s")
            )
        for member in self._active_members():
            self._call_member(member, 0, self._introduce)
        self._introduce_all()
        log.info(
            "in lock-step with %s", ", ".join(m.name for m in self._active_members()) or "nobody"
        )

    def _introduce(self, member: LockstepMember) -> None:
        member.subscribers = tuple(member.proxy.introduce())

    def _introduce_all(self) -> None:
        everyone = [
            *self._ports.subscribers,
            *(h for member in self._active_members() for h in member.subscribers),
        ]
        self._ports.connect(everyone)
        for member in self._active_members():
            self._call_member(member, 0, lambda m: m.proxy.meet(everyone))

    def _active_members(self) -> list[LockstepMember]:
        return [member for member in self._members if not member.lost_since]

    def next_due(self) -> int | None:
        """See `StepCoordinator`."""
        return min(
            (member.next_due for member in self._active_members() if member.next_due != NEVER),
            default=None,
        )

    def run_due(self, tick: Tick) -> None:
        """See `StepCoordinator`."""
        anew, self._resets = tick.epoch != self._resets, tick.epoch
        self._probe_lost(tick)
        for member in self._active_members():
            if anew or member.is_event_driven or NEVER != member.next_due <= tick.time:
                self._call_member(member, tick.time, lambda m: self._advance(m, tick))

    def _advance(self, member: LockstepMember, tick: Tick) -> None:
        due = member.proxy.advance(tick)
        # A member that replies that it is still due would stop time.
        member.next_due = due.time if due.time == NEVER else max(due.time, tick.time + 1)
        member.is_event_driven = due.restless

    def _call_member(
        self, member: LockstepMember, ns: int, question: Callable[[LockstepMember], None]
    ) -> None:
        try:
            question(member)
        except MiddlewareError as error:
            self._drop(member, ns, error)

    def _drop(self, member: LockstepMember, ns: int, error: MiddlewareError) -> None:
        if member.lost_since:
            return
        member.lost_since = time.monotonic()
        message = (
            f"{member.name} timed out or disconnected at {ns / NANO:g} s of simulated time: {error}"
        )
        if self._settings.stops_when_lost:
            self._fail(message)
        else:
            log.warning("%s; the others continue without it", message)

    def _probe_lost(self, tick: Tick) -> None:
        now = time.monotonic()
        for member in self._members:
            if member.lost_since and now - member.lost_since > REJOIN_PERIOD_S:
                member.lost_since = now
                if member.proxy.wait_for_server(0.0) and self._rejoin(member):
                    member.lost_since, member.next_due = 0.0, tick.time
                    self._introduce_all()
                    log.info("%s rejoined at %g s of simulated time", member.name, tick.time / NANO)

    def _rejoin(self, member: LockstepMember) -> bool:
        member.proxy.set_timeout(PROBE_TIMEOUT_S)
        try:
            self._introduce(member)
        except MiddlewareError:
            return False
        finally:
            member.proxy.set_timeout(self._settings.limit)
        return True
