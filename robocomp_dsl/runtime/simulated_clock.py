"""Simulated time as a component hears it from the source.

In: ticks. Out: a `Clock` that goes on with them: it stands still when none come, and begins anew
when the source was reset or started again.
"""

from __future__ import annotations

import threading

from robocomp_dsl.runtime.clock import NANO, Wake
from robocomp_dsl.runtime.clock_interface import Tick


class SimulatedClock:
    """The clock of a component that follows a source."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._told = Tick()
        self._epoch = self._lived = -1
        self._seconds = 0.0
        self._wanted: float | None = None

    @property
    def epoch(self) -> int:
        """See `Clock`."""
        return self._epoch

    @property
    def told(self) -> Tick:
        """The latest tick."""
        return self._told

    def now(self) -> float:
        """Simulated seconds since the last reset; 0 before the first tick."""
        return self._seconds

    def hear(self, tick: Tick) -> None:
        """What the source tells."""
        with self._changed:
            before, self._told = self._told, tick
            # A source that was started again counts its resets from 0, as the one before did.
            anew = self._epoch < 0 or tick.epoch != before.epoch or tick.time < before.time
            self._epoch += anew
            self._seconds = tick.time / NANO
            if anew or (self._wanted is not None and self._seconds >= self._wanted):
                self._changed.notify_all()

    def wait_until(self, moment: float | None, wake: Wake) -> None:
        """See `Clock`; before the first tick no moment has come."""
        wake.listener = self._notify
        with self._changed:
            self._wanted = moment
            self._changed.wait_for(lambda: wake.is_set() or self._reached(moment))
            # An epoch that began while the component was at work ends its next wait.
            self._lived = self._epoch

    def _reached(self, moment: float | None) -> bool:
        anew = self._epoch != self._lived
        return anew or (self._epoch >= 0 and moment is not None and self._seconds >= moment)

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()
