"""Time for the life cycle: what a period is measured by, and how to wait for the next one.

In: moments in s. Out: the present, and waits that end early when something happens.
"""

from __future__ import annotations

import threading
import time
from typing import Protocol


class Clock(Protocol):
    """A clock that a component lives by."""

    def now(self) -> float:
        """Seconds since some fixed moment; never goes back."""

    def wait_until(self, moment: float | None, wake: threading.Event) -> None:
        """Until `now()` is `moment` (None: for ever), or `wake` is set."""


class WallClock:
    """The time of the machine."""

    def now(self) -> float:
        """See `Clock`."""
        return time.monotonic()

    def wait_until(self, moment: float | None, wake: threading.Event) -> None:
        """See `Clock`."""
        if moment is None:
            wake.wait()
        else:
            wake.wait(max(moment - time.monotonic(), 0.0))
