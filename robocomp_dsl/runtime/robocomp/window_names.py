"""The names of Qt that workers with a window use, from PySide6.

In: imports of `legacy.py`. Out: the classes of Qt; a module has also the names that it had in older
versions of Qt: `QtGui` the widgets (Qt 4), `QtWidgets` the actions (Qt 5), `QtCore` the names of
PyQt.
"""

from __future__ import annotations

from types import ModuleType as _Module
from typing import Any as _Any

from robocomp_dsl.runtime.gui import qt as _qt  # isort: skip - reports a missing PySide6
from PySide6.QtCore import *  # noqa: F403
from PySide6.QtGui import *  # type: ignore[assignment] # noqa: F403
from PySide6.QtWidgets import *  # type: ignore[assignment] # noqa: F403


class CurrentApplication:
    """`qApp`, which Qt 6 no longer has: the application of the process."""

    def __getattr__(self, name: str) -> _Any:
        return getattr(_qt.QtCore.QCoreApplication.instance(), name)


def _merged(name: str, *modules: _Module) -> _Any:
    """A module with the public names of `modules`; a later one has precedence."""
    merged = _Module(name)
    for module in modules:
        names = (key for key in dir(module) if not key.startswith("_"))
        vars(merged).update((key, getattr(module, key)) for key in names)
    return merged


QtCore = _merged("QtCore", _qt.QtCore)
QtGui = _merged("QtGui", _qt.QtWidgets, _qt.QtGui)
QtWidgets = _merged("QtWidgets", _qt.QtGui, _qt.QtWidgets)
qApp = CurrentApplication()  # noqa: N816
QtCore.qApp = QtGui.qApp = QtWidgets.qApp = qApp
pyqtSignal = QtCore.pyqtSignal = _qt.QtCore.Signal  # noqa: N816
pyqtSlot = QtCore.pyqtSlot = _qt.QtCore.Slot  # noqa: N816
pyqtProperty = QtCore.pyqtProperty = _qt.QtCore.Property  # noqa: N816
