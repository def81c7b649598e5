"""The names of Qt that workers without a window use, without Qt.

In: imports of `legacy.py`. Out: timers, signals and locks of this package under Qt's names.
A worker with a window has the classes of Qt itself.
"""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from robocomp_dsl.runtime.robocomp.application import QApplication, qApp
from robocomp_dsl.runtime.robocomp.mutexes import QMutex, QMutexLocker, QRecursiveMutex
from robocomp_dsl.runtime.robocomp.signals import Signal
from robocomp_dsl.runtime.robocomp.timers import QTimer

__all__ = [
    "QApplication",
    "QCoreApplication",
    "QMutex",
    "QMutexLocker",
    "QRecursiveMutex",
    "QTimer",
    "QtCore",
    "QtGui",
    "QtWidgets",
    "Signal",
    "Slot",
    "qApp",
]


def Slot(*_: object, **__: object) -> Callable[[Any], Any]:
    """Qt's decorator; the method is unchanged."""
    return lambda method: method


QCoreApplication = QApplication
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
    qApp=qApp,
)
QtWidgets = SimpleNamespace(QApplication=QApplication, qApp=qApp)
QtGui = SimpleNamespace(QApplication=QApplication, qApp=qApp)
