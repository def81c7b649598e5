"""Statistics of a component: counts of calls, bytes and losses, and durations.

Counting uses no lock: a figure may miss a concurrent call, but counting never delays a call.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

TIMING_INTERVAL = 4
"""One in this many calls is timed: reading the clock twice is a large part of a call's cost."""
BRIEF_NS = 20_000
"""Calls that take less are brief; of them, one in `BRIEF_TIMING_INTERVAL` is timed."""
BRIEF_TIMING_INTERVAL = 32
WINDOW = 512
"""Number of latest durations over which percentiles are computed."""


class Durations:
    """The latest durations in ns, and how many there were; one in `interval` calls is timed."""

    __slots__ = ("_latest", "count", "interval")

    def __init__(self) -> None:
        self._latest = [0] * WINDOW
        self.count = 0
        self.interval = TIMING_INTERVAL

    def add(self, nanoseconds: int) -> None:
        """Add a duration."""
        self._latest[self.count % WINDOW] = nanoseconds
        self.count += 1
        self.interval = TIMING_INTERVAL if nanoseconds > BRIEF_NS else BRIEF_TIMING_INTERVAL

    def milliseconds(self, *percents: float) -> tuple[float, ...]:
        """Percentiles of the latest durations in ms; zeros without any."""
        latest = self._latest[: min(self.count, WINDOW)]
        if not latest:
            return tuple(0.0 for _ in percents)
        return tuple(float(v) / 1e6 for v in np.percentile(latest, percents))


@dataclass(slots=True)
class OperationCounts:
    """Counts of one operation of one port. `durations`: call to reply, or of the handler.

    `held`: messages that waited because the queue of the subscriber was full. `place`: `file:line`
    of the declaration that users know, for messages about losses; empty without one.
    """

    port: str
    operation: str
    calls: int = 0
    failures: int = 0
    bytes_in: int = 0
    bytes_out: int = 0
    drops: int = 0
    malformed: int = 0
    missed: int = 0
    held: int = 0
    durations: Durations = field(default_factory=Durations)
    place: str = ""

    @property
    def suffix(self) -> str:
        """The place as the end of a message; empty without one."""
        return f" ({self.place})" if self.place else ""


@dataclass(slots=True)
class Statistics:
    """All counts of a component. `periods`: between two starts of `compute`; `computes`: of it."""

    operations: dict[tuple[str, str], OperationCounts] = field(default_factory=dict)
    periods: Durations = field(default_factory=Durations)
    computes: Durations = field(default_factory=Durations)
    overruns: int = 0
    failures: int = 0

    _refreshers: list[Callable[[], None]] = field(default_factory=list)

    def on_refresh(self, refresh: Callable[[], None]) -> None:
        """Call `refresh` before counts are read that take time to determine."""
        self._refreshers.append(refresh)

    def off_refresh(self, refresh: Callable[[], None]) -> None:
        """Undo `on_refresh`."""
        if refresh in self._refreshers:
            self._refreshers.remove(refresh)

    def refresh(self) -> None:
        """Bring all counts up to date; takes a fraction of a second if peers hang."""
        for refresh in list(self._refreshers):
            refresh()

    def of(self, port: str, operation: str) -> OperationCounts:
        """The counts of one operation, created on first use."""
        return self.operations.setdefault((port, operation), OperationCounts(port, operation))
