"""The base of migrated workers with a window: Qt itself instead of its stand-ins.

In: the user's class, as in `worker.py`. Out: `self.timer` is a timer of Qt, which calls `compute`;
signals and slots are those of Qt, in its thread. As with RoboComp, an exception of `compute` is
logged, and `compute` is called again.
"""

from __future__ import annotations

from collections.abc import Callable
from threading import get_ident
from typing import Any

from robocomp_dsl.runtime.gui.qt import QtCore
from robocomp_dsl.runtime.robocomp.event_loop import EventLoop
from robocomp_dsl.runtime.robocomp.leaving import delete
from robocomp_dsl.runtime.robocomp.worker import (
    DEFAULT_PERIOD_MS,
    LegacyWorker,
)


class QtLoop(EventLoop):
    """The event loop of Qt, for state machines; create it in the thread of Qt."""

    def __init__(self) -> None:
        super().__init__()
        self._thread = get_ident()
        self._application: Any = QtCore.QCoreApplication.instance()

    @property
    def is_here(self) -> bool:
        """Whether the calling thread is that of Qt."""
        return get_ident() == self._thread

    def post(self, function: Callable[[], object]) -> None:
        """Call a function when the current slot has returned."""
        self.call_later(0.0, function)

    def call_later(self, seconds: float, function: Callable[[], object]) -> None:
        """Call a function after a delay."""
        QtCore.QTimer.singleShot(round(1000 * seconds), self._application, function)


class LegacyWindow(LegacyWorker):
    """Runs the code of a RoboComp worker that is a window."""

    kill = QtCore.Signal()

    def begin(self, old_init: Callable[..., object]) -> None:
        """See `LegacyWorker.begin`."""
        window: Any = self
        loop = self._loop = QtLoop()
        self.Period = DEFAULT_PERIOD_MS
        self.timer = QtCore.QTimer(window)
        self.mutex = QtCore.QRecursiveMutex()
        window.kill.connect(self._request_stop)
        self._add_machine(loop)
        self._lifecycle.set_period(0)  # the timer calls `compute`
        self._call_old_methods(old_init)

    def finalize(self) -> None:
        """Call `__del__`, which closes devices."""
        delete(self)
