"""The base of a worker with a window.

The generated class extends it and the class of Qt that the CDSL file names. The window has the
widgets of the `.ui` file in `ui`, and is shown when the object exists.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.errors import WindowError
from robocomp_dsl.runtime.gui.form_finder import install_finder
from robocomp_dsl.runtime.gui.qt import QtWidgets
from robocomp_dsl.runtime.gui.ui_file import find_ui_file, load_form

__all__ = ["QtWidgets", "WindowComponent"]


class WindowComponent(Component):
    """A component that is a window.

    `ui` has the widgets of `mainUI.ui` by name. The hooks run in the thread of Qt, so they may use
    widgets; other threads, such as handlers, emit signals. Closing the window stops the component.
    """

    ui: Any  # of the class that Qt generates from the file

    def __init_subclass__(cls, **rest: Any) -> None:
        super().__init_subclass__(**rest)
        install_finder(_folder_of(cls))

    def __init__(self) -> None:
        if "ui" in vars(self):  # code from RoboComp calls it again
            return
        super().__init__()
        if not isinstance(self, QtWidgets.QWidget):
            raise TypeError(f"{type(self).__name__} extends no window of Qt")
        path = find_ui_file(_folder_of(type(self)))
        self.ui = load_form(path)
        try:
            self.ui.setupUi(self)
        except AttributeError as error:
            kind = next(base for base in type(self).__mro__ if base.__module__.startswith("PySide"))
            message = f"{path}: the form does not fit the window of the component, a"
            raise WindowError(f"{message} {kind.__name__}: {error}") from None
        self.show()


def _folder_of(cls: type) -> Path:
    """The folder of the component to which a class belongs."""
    module = sys.modules.get(cls.__module__)
    folder = Path(getattr(module, "__file__", None) or "main.py").parent
    return folder.parent if folder.name.endswith("_generated") else folder
