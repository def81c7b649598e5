"""Simulated time as a component hears it from the source.

In: ticks. Out: a `Clock` that goes on with them: it stands still when none come, and begins anew
when the source was reset or started again. That a source has ended or hangs is known by the clock
of the machine alone: also one that holds the time tells so every half second.
"""

from __future__ import annotations

import threading
import time

from robocomp_dsl.runtime.clock import NANO, Wake
from robocomp_dsl.runtime.clock_interface import Tick

SILENT_S = 3.0
"""A source that has told nothing for so long is not there."""
AGAIN_S = 0.5
"""While it is not, waits end after this time."""


class SimulatedClock:
    """The clock of a component that follows a source; `patience` is in s of the machine."""

    def __init__(self, patience: float = SILENT_S) -> None:
        self._patience = patience
        self._heard = time.monotonic()
        self._silent = False
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
    def silent(self) -> bool:
        """See `Clock`."""
        return self._silent

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
            again, self._silent = self._silent, False
            self._heard = time.monotonic()
            if anew or again or (self._wanted is not None and self._seconds >= self._wanted):
                self._changed.notify_all()

    def wait_until(self, moment: float | None, wake: Wake) -> None:
        """See `Clock`; before the first tick no moment has come."""
        wake.listener = self._notify
        with self._changed:
            self._wanted, silent = moment, self._silent
            while not (wake.is_set() or self._reached(moment) or silent is not self._silent):
                self._changed.wait(self._worth_waiting())
                if self._epoch >= 0 and time.monotonic() - self._heard >= self._patience:
                    self._silent = True
                    return
            # An epoch that began while the component was at work ends its next wait.
            self._lived = self._epoch

    def _worth_waiting(self) -> float:
        """Until the source counts as silent; then for a while."""
        left = self._heard + self._patience - time.monotonic()
        return AGAIN_S if self._silent or left <= 0.0 else left

    def _reached(self, moment: float | None) -> bool:
        anew = self._epoch != self._lived
        return anew or (self._epoch >= 0 and moment is not None and self._seconds >= moment)

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()
