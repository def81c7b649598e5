"""Counts of what a component does: calls, bytes, times, losses. In: events. Out: figures.

Counting is a few additions under no lock: a figure may miss a call of another thread, which nobody
will notice, but never costs the call.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

TIMED_EACH = 4
"""Of so many calls one is timed: reading the clock twice is a good part of what a call costs."""
KEPT = 512
"""Durations that a percentile is taken over: the latest ones."""


class Durations:
    """The latest durations in ns, and how many there were."""

    __slots__ = ("_kept", "count")

    def __init__(self) -> None:
        self._kept = [0] * KEPT
        self.count = 0

    def add(self, nanoseconds: int) -> None:
        """One more."""
        self._kept[self.count % KEPT] = nanoseconds
        self.count += 1

    def milliseconds(self, *percents: float) -> tuple[float, ...]:
        """Percentiles of the latest, in ms; zeros when there are none."""
        kept = self._kept[: min(self.count, KEPT)]
        if not kept:
            return tuple(0.0 for _ in percents)
        return tuple(float(v) / 1e6 for v in np.percentile(kept, percents))


@dataclass(slots=True)
class OperationCounts:
    """One operation of one port. `durations`: of a call until its answer, or of a handler."""

    port: str
    operation: str
    calls: int = 0
    failures: int = 0
    bytes_in: int = 0
    bytes_out: int = 0
    drops: int = 0
    malformed: int = 0
    missed: int = 0
    durations: Durations = field(default_factory=Durations)


@dataclass(slots=True)
class Statistics:
    """All counts of a component; `periods` between two starts of `compute`, `computes` of it."""

    operations: dict[tuple[str, str], OperationCounts] = field(default_factory=dict)
    periods: Durations = field(default_factory=Durations)
    computes: Durations = field(default_factory=Durations)
    overruns: int = 0
    failures: int = 0

    def of(self, port: str, operation: str) -> OperationCounts:
        """The counts of one operation, made on first use."""
        return self.operations.setdefault((port, operation), OperationCounts(port, operation))
