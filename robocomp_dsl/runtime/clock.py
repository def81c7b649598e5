"""Clocks of a component: the protocol, the wall clock, and the event that ends a wait.

Times are seconds since a fixed moment of the clock.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Protocol

from robocomp_dsl.runtime.deprecated import DeprecatedClockNames

NANO = 1_000_000_000
TIME_DIGITS = 9
"""Times are rounded to ns, so that sums of periods equal the times of the clock source."""
CLOCK_LOST = "simulated clock lost: the clock source exited or is not responding"
"""The reason of an emergency while a clock is stale."""


class WakeEvent(threading.Event):
    """Ends a wait early. `stopped`: the component stops; waits return immediately."""

    def __init__(self) -> None:
        super().__init__()
        self.stopped = False
        self.on_set: Callable[[], None] | None = None

    def set(self) -> None:
        """Wake the waiting thread."""
        super().set()
        if self.on_set:
            self.on_set()

    def stop(self) -> None:
        """Stop the component: no wait blocks any more."""
        self.stopped = True
        self.set()


class Clock(Protocol):
    """The clock of a component."""

    @property
    def reset_count(self) -> int:
        """How often time was reset; -1: the clock has not started."""

    @property
    def is_stale(self) -> bool:
        """Whether the clock source exited or is not responding; a paused clock is not stale."""

    def now(self) -> float:
        """Seconds since a fixed moment; decreases only after a reset (see `reset_count`)."""

    def wait_until(self, moment: float | None, wake: WakeEvent) -> None:
        """Wait until `now()` is `moment` (None: no limit), `wake` is set or time was reset.

        While `is_stale`, waits return periodically.
        """


class WallClock(DeprecatedClockNames):
    """The monotonic clock of the system."""

    reset_count = 0
    is_stale = False

    def now(self) -> float:
        """See `Clock`."""
        return time.monotonic()

    def wait_until(self, moment: float | None, wake: threading.Event) -> None:
        """See `Clock`."""
        if moment is None:
            wake.wait()
        else:
            wake.wait(max(moment - time.monotonic(), 0.0))
