"""Simulated time as a component receives it from the clock source.

In: ticks. Out: a `Clock` that follows them: it stops when no ticks arrive, and resets when the
source was reset or restarted. The system clock detects a lost source: a paused source also sends
ticks.
"""

from __future__ import annotations

import threading
import time

from robocomp_dsl.runtime.clock import NANO, WakeEvent
from robocomp_dsl.runtime.deprecated import DeprecatedClockNames
from robocomp_dsl.runtime.time.clock_interface import Tick

STALE_TIMEOUT_S = 3.0
"""Without a tick for this time the source counts as lost."""
STALE_POLL_S = 0.5
"""While the source is lost, waits end after this time."""


class SimulatedClock(DeprecatedClockNames):
    """The clock of a component that follows a source; `timeout` in s of wall time."""

    def __init__(self, timeout: float = STALE_TIMEOUT_S) -> None:
        self._timeout = timeout
        self._received_at = time.monotonic()
        self._stale = False
        self._changed = threading.Condition()
        self._latest_tick = Tick()
        self._resets = self._resets_seen = -1
        self._seconds = 0.0
        self._target: float | None = None

    @property
    def reset_count(self) -> int:
        """See `Clock`."""
        return self._resets

    @property
    def is_stale(self) -> bool:
        """See `Clock`."""
        return self._stale

    @property
    def latest_tick(self) -> Tick:
        """The latest tick."""
        return self._latest_tick

    def now(self) -> float:
        """Simulated seconds since the last reset; 0 before the first tick."""
        return self._seconds

    def on_tick(self, tick: Tick) -> None:
        """Handle a tick of the source."""
        with self._changed:
            before, self._latest_tick = self._latest_tick, tick
            # A restarted source counts its resets from 0 again.
            was_reset = self._resets < 0 or tick.epoch != before.epoch or tick.time < before.time
            self._resets += was_reset
            self._seconds = tick.time / NANO
            recovered, self._stale = self._stale, False
            self._received_at = time.monotonic()
            if (
                was_reset
                or recovered
                or (self._target is not None and self._seconds >= self._target)
            ):
                self._changed.notify_all()

    def wait_until(self, moment: float | None, wake: WakeEvent) -> None:
        """See `Clock`; before the first tick no wait ends by time."""
        wake.on_set = self._notify
        with self._changed:
            self._target, stale = moment, self._stale
            while not (wake.is_set() or self._reached(moment) or stale is not self._stale):
                self._changed.wait(self._wait_time())
                if self._resets >= 0 and time.monotonic() - self._received_at >= self._timeout:
                    self._stale = True
                    return
            # A reset during the work of the component ends its next wait.
            self._resets_seen = self._resets

    def _wait_time(self) -> float:
        """Seconds until the source counts as lost; then the polling period."""
        left = self._received_at + self._timeout - time.monotonic()
        return STALE_POLL_S if self._stale or left <= 0.0 else left

    def _reached(self, moment: float | None) -> bool:
        was_reset = self._resets != self._resets_seen
        return was_reset or (self._resets >= 0 and moment is not None and self._seconds >= moment)

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()
