"""Time for the life cycle: what a period is measured by, and how to wait for the next one.

In: moments in s. Out: the present, and waits that end early when something happens.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Protocol

NANO = 1_000_000_000
DIGITS = 9
"""Moments are rounded to ns, so that sums of periods meet the times that a source tells."""
TIMELESS = "nobody tells the time any more: whoever makes it has ended, or hangs"
"""The reason of an emergency while a clock is `silent`."""


class Wake(threading.Event):
    """Ends a wait early. `over`: the component is to end, nothing holds it any more."""

    def __init__(self) -> None:
        super().__init__()
        self.over = False
        self.listener: Callable[[], None] | None = None

    def set(self) -> None:
        """Something happened."""
        super().set()
        if self.listener:
            self.listener()

    def end(self) -> None:
        """The component is to end."""
        self.over = True
        self.set()


class Clock(Protocol):
    """A clock that a component lives by."""

    @property
    def epoch(self) -> int:
        """How often time has begun anew; -1: it has not begun at all."""

    @property
    def silent(self) -> bool:
        """Whether time stands still because who makes it has ended or hangs: it is no pause."""

    def now(self) -> float:
        """Seconds since some fixed moment; goes back only with another `epoch`."""

    def wait_until(self, moment: float | None, wake: Wake) -> None:
        """Until `now()` is `moment` (None: for ever), `wake` is set or the epoch is another.

        While it is `silent`, a wait ends now and then.
        """


class WallClock:
    """The time of the machine."""

    epoch = 0
    silent = False

    def now(self) -> float:
        """See `Clock`."""
        return time.monotonic()

    def wait_until(self, moment: float | None, wake: threading.Event) -> None:
        """See `Clock`."""
        if moment is None:
            wake.wait()
        else:
            wake.wait(max(moment - time.monotonic(), 0.0))
