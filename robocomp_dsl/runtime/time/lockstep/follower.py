"""The clock of a component in lock-step: its lifecycle runs only when the source permits it.

In: `advance` from the source, the time in every message. Out: a `Clock`, and the time when the
component is due next.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

from robocomp_dsl.runtime.clock import NANO, WakeEvent
from robocomp_dsl.runtime.deprecated import DeprecatedClockNames
from robocomp_dsl.runtime.time.clock_interface import Due, Hearer, Tick
from robocomp_dsl.runtime.time.lockstep.ports import LockstepPorts

NEVER = -1


class LockstepClock(DeprecatedClockNames):
    """The clock, and the servant of `LockstepClock` of `interfaces/LockStep.idsl`."""

    is_stale = False  # a source that waits for members sends no ticks

    def __init__(self, limit: float, is_event_driven: Callable[[], bool]) -> None:
        self._limit = limit
        self._is_event_driven = is_event_driven
        self._changed = threading.Condition()
        self._latest_tick = Tick()
        self._ns = 0
        self._resets = self._resets_seen = -1
        self._due: float | None = None
        self._wake = WakeEvent()
        self._idle = False
        self._granted = False
        self._introduced = False

    @property
    def reset_count(self) -> int:
        """See `Clock`."""
        return self._resets

    @property
    def latest_tick(self) -> Tick:
        """The latest tick."""
        return self._latest_tick

    @property
    def nanoseconds(self) -> int:
        """The present time in ns."""
        return self._ns

    def now(self) -> float:
        """Simulated seconds since the last reset; 0 before the first step."""
        return self._ns / NANO

    def set_time(self, ns: int) -> None:
        """Set the time of a message that was received."""
        self._ns = ns

    def wait_until(self, moment: float | None, wake: WakeEvent) -> None:
        """See `Clock`; any wake-up but a stop waits until the source grants a step."""
        wake.on_set = self._notify
        with self._changed:
            self._due, self._wake, self._idle = moment, wake, True
            self._changed.notify_all()
            self._changed.wait_for(lambda: wake.stopped or self._granted)
            self._granted = self._idle = False
            self._resets_seen = self._resets

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()

    def handlers(self, ports: LockstepPorts) -> Mapping[str, Any]:
        """Handlers by operation name."""

        def introduce() -> list[Hearer]:
            self._introduced = True
            return ports.subscribers

        return {"introduce": introduce, "meet": ports.connect, "advance": self.advance}

    def advance(self, t: Tick) -> Due:
        """Run the lifecycle at time `t`; returns when the component is due next.

        Raises `RuntimeError` if the source takes it for an earlier instance: no component receives
        its publications until it was introduced.
        """
        if not self._introduced:
            raise RuntimeError("the component was restarted and is not introduced yet")
        with self._changed:
            self._wait_until_idle()
            # A restarted source counts its resets from 0 again.
            was_reset = t.epoch != self._latest_tick.epoch or t.time < self._latest_tick.time
            self._resets += was_reset or self._resets < 0
            self._latest_tick, self._ns = t, t.time
            while self._is_due():
                self._granted, self._idle = True, False
                self._changed.notify_all()
                self._wait_until_idle()
            due = NEVER if self._due is None else round(self._due * NANO)
            return Due(due, self._is_event_driven())

    def _wait_until_idle(self) -> None:
        if not self._changed.wait_for(lambda: self._idle or self._wake.stopped, self._limit):
            raise TimeoutError(f"still running after {self._limit:g} s")

    def _is_due(self) -> bool:
        if self._wake.stopped:
            return False
        if self._wake.is_set() or self._resets != self._resets_seen:
            return True
        return self._due is not None and self.now() >= self._due
