"""When the cycles of a component are due: a fixed phase, without the cycles that were missed."""

from __future__ import annotations

import logging

from robocomp_dsl.runtime.clock import TIME_DIGITS, Clock
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.component.throttle import Throttle

OVERRUN = "compute exceeded its period of %g ms by %.1f ms; overruns since the start: %d"
log = logging.getLogger("robocomp")


class PeriodSchedule:
    """Counts and logs the cycles that take longer than their period."""

    def __init__(self, clock: Clock, statistics: Statistics) -> None:
        self._clock = clock
        self._statistics = statistics
        self._throttle = Throttle()

    def next_due(self, due: float, period: float | None) -> float:
        """When the cycle after that of `due` [s] starts; now if there is no period [s]."""
        now = self._clock.now()
        if period is None:
            return now
        due += period
        if due < now:
            self._statistics.overruns += 1
            if self._throttle.allows("overrun"):
                log.warning(OVERRUN, 1000 * period, 1000 * (now - due), self._statistics.overruns)
            # Keep the phase, so that a slow cycle does not shift the following ones.
            due += ((now - due) // period) * period
        return round(due, TIME_DIGITS)
