"""Timers as workers use them: `QTimer`, and `self.timer`, which drives `compute`.

In: intervals in ms, slots of the signal `timeout`. Out: the slots are called by the event loop of
the worker; those of `self.timer` by the lifecycle, whose period is the timer's interval.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.robocomp.event_loop import EventLoop
from robocomp_dsl.runtime.robocomp.signals import BoundSignal

SHORTEST_MS = 1
"""Qt's interval 0 means as often as possible; the lifecycle needs a period."""


class QTimer:
    """Emits `timeout` every interval while it is active."""

    def __init__(self, *_: object, **__: object) -> None:
        self._loop = EventLoop.current()
        self.timeout = BoundSignal(self._loop)
        self._interval = 0
        self._single = False
        self._start_count = 0
        self._active = False

    def start(self, interval: Any = None) -> None:
        """Start with this interval in ms, or the previous one; restart if it is active."""
        if interval is not None:
            self._interval = _milliseconds(interval)
        self._start_count += 1
        self._active = True
        self._schedule()

    def stop(self) -> None:
        """Emit no more until `start`."""
        self._start_count += 1
        self._active = False

    def setInterval(self, interval: Any) -> None:
        """Change the interval in ms; an active timer continues with it."""
        self._interval = _milliseconds(interval)
        if self._active:
            self.start()

    def interval(self) -> int:
        """The interval in ms."""
        return self._interval

    def isActive(self) -> bool:
        """Whether it runs."""
        return self._active

    def setSingleShot(self, single: bool) -> None:
        """Whether it stops after the first `timeout`."""
        self._single = bool(single)

    def isSingleShot(self) -> bool:
        """Whether it stops after the first `timeout`."""
        return self._single

    def setTimerType(self, *_: object) -> None:
        """Does nothing: the precision is that of the system."""

    def fire(self) -> None:
        """Call the slots, if the timer is active."""
        if self._active:
            self._active = not self._single
            self.timeout.call_slots()

    @staticmethod
    def singleShot(milliseconds: Any, *slot: Any) -> None:
        """Call a function after a delay; a context or type of timer before it has no effect."""
        function: Callable[[], object] = slot[-1]
        call = getattr(function, "emit", function)
        EventLoop.current().call_later(_milliseconds(milliseconds) / 1000, call)

    def _schedule(self) -> None:
        number = self._start_count

        def due() -> None:
            if number != self._start_count:
                return
            if not self._single:
                self._schedule()
            self.fire()

        self._loop.call_later(max(self._interval, SHORTEST_MS) / 1000, due)


class ComputeTimer(QTimer):
    """`self.timer` of a worker: it sets the period of the lifecycle, which calls `fire`."""

    def __init__(self, loop: EventLoop, set_period: Callable[[float], None]) -> None:
        self._used = False
        super().__init__()
        self._loop = loop
        self.timeout = BoundSignal(loop)
        self._set_period = set_period

    @property
    def is_used(self) -> bool:
        """Whether the worker has ever started, stopped or connected it."""
        return self._used or self.timeout.is_connected

    def stop(self) -> None:
        """Call no slots until `start`."""
        self._used = True
        super().stop()

    def _schedule(self) -> None:
        self._used = True
        self._set_period(max(self._interval, SHORTEST_MS))


def _milliseconds(interval: Any) -> int:
    """An interval in ms; a `timedelta` has its duration."""
    seconds = getattr(interval, "total_seconds", None)
    return int(seconds() * 1000) if seconds else int(interval)
