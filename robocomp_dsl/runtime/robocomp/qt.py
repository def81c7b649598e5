"""The names of Qt that workers without a window use, without Qt.

In: imports of `legacy.py`. Out: timers, signals and locks of this package under Qt's names.
A worker with a window has the classes of Qt itself.
"""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from robocomp_dsl.runtime.robocomp.event_loop import EventLoop
from robocomp_dsl.runtime.robocomp.mutexes import QMutex, QMutexLocker, QRecursiveMutex
from robocomp_dsl.runtime.robocomp.signals import Signal
from robocomp_dsl.runtime.robocomp.timers import QTimer

__all__ = [
    "QApplication",
    "QMutex",
    "QMutexLocker",
    "QRecursiveMutex",
    "QTimer",
    "QtCore",
    "QtGui",
    "QtWidgets",
    "Signal",
    "Slot",
]


def Slot(*_: object, **__: object) -> Callable[[Any], Any]:
    """Qt's decorator; the method is unchanged."""
    return lambda method: method


class QApplication:
    """The application: `quit` stops the component."""

    @staticmethod
    def instance() -> QApplication:
        """The application."""
        return QApplication()

    @staticmethod
    def quit() -> None:
        """Stop the component."""
        EventLoop.current().quit()


QtCore = SimpleNamespace(
    QCoreApplication=QApplication,
    QMutex=QMutex,
    QMutexLocker=QMutexLocker,
    QRecursiveMutex=QRecursiveMutex,
    QTimer=QTimer,
    Signal=Signal,
    Slot=Slot,
    pyqtSignal=Signal,
    pyqtSlot=Slot,
)
QtWidgets = SimpleNamespace(QApplication=QApplication)
QtGui = SimpleNamespace(QApplication=QApplication)
