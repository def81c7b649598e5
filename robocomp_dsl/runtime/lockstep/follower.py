"""The clock of a component in lock-step: its life goes on only while the source has told it to.

In: `advance` from the source, the time that comes with every message. Out: a `Clock`, and when the
component has something to do next.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

from robocomp_dsl.runtime.clock import NANO, Wake
from robocomp_dsl.runtime.clock_interface import Due, Hearer, Tick
from robocomp_dsl.runtime.lockstep.ports import StepPorts

NOTHING = -1


class Follower:
    """The clock, and the servant of `Follower` of `interfaces/LockStep.idsl`."""

    silent = False  # a source that waits for others is not heard of either

    def __init__(self, limit: float, restless: Callable[[], bool]) -> None:
        self._limit = limit
        self._restless = restless
        self._changed = threading.Condition()
        self._told = Tick()
        self._ns = 0
        self._epoch = self._lived = -1
        self._due: float | None = None
        self._wake = Wake()
        self._idle = False
        self._granted = False
        self._introduced = False

    @property
    def epoch(self) -> int:
        """See `Clock`."""
        return self._epoch

    @property
    def told(self) -> Tick:
        """The latest tick."""
        return self._told

    @property
    def nanoseconds(self) -> int:
        """The present."""
        return self._ns

    def now(self) -> float:
        """Simulated seconds since the last reset; 0 before the first step."""
        return self._ns / NANO

    def reach(self, ns: int) -> None:
        """A message from this time has come."""
        self._ns = ns

    def wait_until(self, moment: float | None, wake: Wake) -> None:
        """See `Clock`; what else wakes the component waits for its turn, too, but for its end."""
        wake.listener = self._notify
        with self._changed:
            self._due, self._wake, self._idle = moment, wake, True
            self._changed.notify_all()
            self._changed.wait_for(lambda: wake.over or self._granted)
            self._granted = self._idle = False
            self._lived = self._epoch

    def _notify(self) -> None:
        with self._changed:
            self._changed.notify_all()

    def handlers(self, ports: StepPorts) -> Mapping[str, Any]:
        """Operation to method."""

        def introduce() -> list[Hearer]:
            self._introduced = True
            return ports.hearers

        return {"introduce": introduce, "meet": ports.meet, "advance": self.advance}

    def advance(self, t: Tick) -> Due:
        """It is `t`: let the life cycle do what is due; what is next.

        Raises `RuntimeError` where the source takes it for one that went before it: nobody hears
        what this one publishes until it has been introduced.
        """
        if not self._introduced:
            raise RuntimeError("it was started again, and is not introduced yet")
        with self._changed:
            self._until_idle()
            # A source that was started again counts its resets from 0, as the one before did.
            anew = t.epoch != self._told.epoch or t.time < self._told.time
            self._epoch += anew or self._epoch < 0
            self._told, self._ns = t, t.time
            while self._is_due():
                self._granted, self._idle = True, False
                self._changed.notify_all()
                self._until_idle()
            due = NOTHING if self._due is None else round(self._due * NANO)
            return Due(due, self._restless())

    def _until_idle(self) -> None:
        if not self._changed.wait_for(lambda: self._idle or self._wake.over, self._limit):
            raise TimeoutError(f"it is still at work after {self._limit:g} s")

    def _is_due(self) -> bool:
        if self._wake.over:
            return False
        if self._wake.is_set() or self._epoch != self._lived:
            return True
        return self._due is not None and self.now() >= self._due
