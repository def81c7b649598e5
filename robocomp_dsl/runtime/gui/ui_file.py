"""Loads the `.ui` file of a window, which Qt Designer writes.

In: the folder of the worker. Out: the class that Qt's compiler `uic` generates from the file, as in
RoboComp: its `setupUi(window)` creates the widgets, and its attributes are named after them.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from shutil import which
from typing import Any, Protocol

from robocomp_dsl.runtime.errors import WindowError
from robocomp_dsl.runtime.gui.qt import QtCore

UI_FILES = ("mainUI.ui", "src/mainUI.ui")
"""The `.ui` file, relative to the folder of the worker; the first one that exists is used."""
_UIC_TIMEOUT_S = 60.0


class UiForm(Protocol):
    """The generated class of a window."""

    def setupUi(self, window: Any, /) -> None:  # noqa: N802 - the name of Qt
        """Create the widgets in `window`."""


def find_ui_file(folder: Path) -> Path:
    """The `.ui` file of the worker in `folder`. Raises `WindowError`."""
    for name in UI_FILES:
        if (path := folder / name).is_file():
            return path
    raise WindowError(
        f"{folder / UI_FILES[0]}: the file of the window does not exist; `rcgen component` writes"
        " it, and Qt Designer (pyside6-designer) edits it"
    )


def load_form(path: Path) -> UiForm:
    """The form of a `.ui` file. Raises `WindowError`."""
    names: dict[str, Any] = {}
    try:
        exec(compile(compile_form(path), str(path), "exec"), names)  # noqa: S102 - Qt's compiler
    except ImportError as error:
        message = f"{path}: a widget or resource of the window cannot be imported: {error}"
        raise WindowError(message) from error
    create: Callable[[], UiForm] = next(
        value for name, value in names.items() if name.startswith("Ui_")
    )
    return create()


def compile_form(path: Path) -> str:
    """The module that Qt's compiler generates from a `.ui` file. Raises `WindowError`."""
    return _run_compiler("uic", ["-g", "python"], path)


def compile_resources(path: Path) -> str:
    """The module with the files that a `.qrc` file names. Raises `WindowError`."""
    return _run_compiler("rcc", ["-g", "python"], path)


def _run_compiler(name: str, arguments: list[str], path: Path) -> str:
    """The output of one of Qt's compilers. Raises `WindowError`."""
    folder = QtCore.QLibraryInfo.path(QtCore.QLibraryInfo.LibraryPath.LibraryExecutablesPath)
    program = which(name, path=folder) or which(f"pyside6-{name}")
    if program is None:
        raise WindowError(
            f"{path}: the program `pyside6-{name}` of PySide6 is missing; install it:"
            f" {sys.executable} -m pip install 'robocomp_dsl[gui]'"
        )
    try:
        result = subprocess.run(  # noqa: S603 - a program of PySide6
            [program, *arguments, str(path)],
            capture_output=True,
            timeout=_UIC_TIMEOUT_S,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise WindowError(f"{path}: `{program}` failed: {error}") from None
    if result.returncode:
        errors = result.stderr.decode("utf-8", "replace").strip().splitlines()
        reason = next((line for line in errors if name in line), "it is not valid")
        raise WindowError(f"{path}: not a valid file of Qt Designer: {reason}")
    return result.stdout.decode("utf-8", "replace")
