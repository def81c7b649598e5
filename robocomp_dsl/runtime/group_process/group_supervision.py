"""Joins what the components of one process report into what its supervisor expects of a process.

In: lifecycle states, pings, heartbeats and hangs of the members. Out: one state, `READY=1` when all
members are ready, a ping when none hangs, heartbeats.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import replace

from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.component.supervision import HangNotifier, StateNotifier, Supervision

READY_STATES = ("compute", "emergency", "restore")


class GroupSupervision:
    """Reports for all members; `states` and `hangs` are those of the process."""

    def __init__(self, members: Iterable[str], states: StateNotifier, hangs: HangNotifier) -> None:
        self._states = states
        self._hangs = hangs
        self._lock = threading.Lock()
        self._latest = dict.fromkeys(members, ("initialize", ""))
        self._pinged: set[str] = set()
        self._intervals: dict[str, float] = {}

    def of_member(self, name: str, on_ready: Callable[[], None]) -> Supervision:
        """What one member reports to; `on_ready` is called at every state in which it is ready."""
        return Supervision(
            _MemberStates(self, name, self._states.watchdog_s, on_ready),
            _MemberHangs(self, name),
            in_group=True,
        )

    def state_changed(self, name: str, state: str, reason: str) -> None:
        """A member has reached a state."""
        with self._lock:
            self._latest[name] = (state, reason)
            self._states.state_changed(*self._combined())

    def _combined(self) -> tuple[str, str]:
        """The state that is furthest from `compute`, and its reason with the member's name."""
        for priority in ("finalize", "initialize", "emergency", "restore"):
            for name, (state, reason) in self._latest.items():
                if state == priority:
                    return state, f"{name}: {reason}" if reason else name
        return "compute", ""

    def ping(self, name: str) -> None:
        """A member does not hang; the process does not if all its members did not since."""
        with self._lock:
            self._pinged.add(name)
            if self._pinged >= self._latest.keys():
                self._pinged.clear()
                self._states.ping()

    def beat(self, name: str, seconds: float) -> None:
        """A member beats again within `seconds`; 0: never."""
        with self._lock:
            self._intervals[name] = seconds
            self._hangs.beat(max(self._intervals.values()))

    def report(self, name: str, report: HangReport) -> None:
        """A member hangs."""
        self._hangs.report(replace(report, activity=f"{report.activity} of {name}"))

    def ended(self, name: str) -> None:
        """A member has ended: nothing is expected of it."""
        with self._lock:
            self._latest.pop(name, None)
            self._pinged.discard(name)
            if self._intervals.pop(name, None):
                self._hangs.beat(max(self._intervals.values(), default=0.0))


class _MemberStates:
    """A `StateNotifier`."""

    def __init__(
        self, group: GroupSupervision, name: str, watchdog_s: float, on_ready: Callable[[], None]
    ) -> None:
        self.watchdog_s = watchdog_s
        self._group = group
        self._name = name
        self._on_ready = on_ready

    def state_changed(self, state: str, reason: str = "") -> None:
        self._group.state_changed(self._name, state, reason)
        if state in READY_STATES:
            self._on_ready()

    def ping(self) -> None:
        self._group.ping(self._name)


class _MemberHangs:
    """A `HangNotifier`."""

    def __init__(self, group: GroupSupervision, name: str) -> None:
        self._group = group
        self._name = name

    def beat(self, seconds: float) -> None:
        self._group.beat(self._name, seconds)

    def report(self, report: HangReport) -> None:
        self._group.report(self._name, report)
