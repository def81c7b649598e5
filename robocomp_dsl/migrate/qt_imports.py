"""Adapt imports of Qt in the modules of a component with a window: they become imports of PySide6.

In: an import statement. Out: its new text, and what Qt 6 lacks. The names of the modules that
RoboComp used, `QtCore`, `QtGui` and `QtWidgets`, come from `legacy.py`, which has each name in all
modules in which older versions of Qt had it.
"""

from __future__ import annotations

import ast
import importlib.util
import re
from contextlib import suppress
from functools import cache
from pathlib import Path

QT = ("PySide", "PySide2", "PySide6", "PyQt4", "PyQt5", "PyQt6")
"""Packages of Qt for Python."""
PROVIDED = frozenset(("QtCore", "QtGui", "QtWidgets"))
"""Modules whose names `legacy.py` has."""
_ESSENTIAL = """QtConcurrent QtDBus QtDesigner QtHelp QtNetwork QtOpenGL QtOpenGLWidgets
QtPrintSupport QtQml QtQuick QtQuickWidgets QtSql QtSvg QtSvgWidgets QtTest QtUiTools QtXml"""
ESSENTIAL = frozenset(_ESSENTIAL.split())
"""Further modules that the extra `gui` installs."""
_REMOVED = """QDesktopWidget QGLWidget QMatrix QRegExp QRegExpValidator QSignalMapper QSound QString
QStringList QTextCodec QVariant QWebView QFinalState QState QStateMachine"""
REMOVED = frozenset(_REMOVED.split())
"""Classes that Qt 6 no longer has, or not in these modules."""
_CLASS = re.compile(r"Q[A-Z]\w+")
_DECLARED_CLASS = re.compile(r"^class (\w+)", re.MULTILINE)


def is_qt(module: str) -> bool:
    """Whether a module belongs to Qt for Python."""
    return module.partition(".")[0] in QT


def adapted_from_import(node: ast.ImportFrom, legacy: str) -> str | None:
    """The new text of `from PySide2.QtCore import QTimer`; None if it needs no change."""
    package, _, module = (node.module or "").partition(".")
    listed = [(alias.name, _as(alias)) for alias in node.names]
    if module in PROVIDED:
        return f"from {legacy} import {', '.join(listed_as for _, listed_as in listed)}"
    if module:
        text = f"from PySide6.{module} import {', '.join(listed_as for _, listed_as in listed)}"
        return text if package != "PySide6" else None
    provided = [listed_as for name, listed_as in listed if name in PROVIDED or name == "*"]
    others = [listed_as for name, listed_as in listed if name not in PROVIDED and name != "*"]
    statements = [f"from {legacy} import {', '.join(provided)}"] if provided else []
    statements += [f"from PySide6 import {', '.join(others)}"] if others else []
    return "; ".join(statements)


def adapted_import(alias: ast.alias) -> str:
    """The new text of `import PySide2.QtCore as QtCore`."""
    package, dot, module = alias.name.partition(".")
    suffix = f" as {alias.asname}" if alias.asname else "" if dot else f" as {package}"
    return f"import PySide6{dot}{module}{suffix}"


def missing_in_qt6(node: ast.Import | ast.ImportFrom, used: dict[str, set[str]]) -> str | None:
    """What an import of Qt names and PySide6-Essentials lacks; None if it has all."""
    if isinstance(node, ast.Import):
        modules = [a.name.partition(".")[2] for a in node.names if is_qt(a.name)]
    elif (module := (node.module or "").partition(".")[2]) in PROVIDED:
        gone = _gone({alias.name for alias in node.names})
        return f"`{gone[0]}`, which Qt 6 does not have" if gone else None
    else:
        modules = [module] if module else [a.name for a in node.names if a.name != "*"]
        for name in PROVIDED.intersection(modules):
            if gone := _gone({u.removesuffix("()") for u in used.get(name, ())}):
                return f"`{name}.{gone[0]}`, which Qt 6 does not have"
    for module in modules:
        if module and module not in PROVIDED | ESSENTIAL:
            return f"`{module}`, which may be in PySide6-Addons (`pip install PySide6`)"
    return None


def _gone(names: set[str]) -> list[str]:
    """The classes that the modules of Qt 6 do not have."""
    classes = _classes()
    if not classes:  # PySide6 is not installed here
        return sorted(REMOVED & names)
    return sorted(name for name in names if _CLASS.fullmatch(name) and name not in classes)


@cache
def _classes() -> frozenset[str]:
    """The classes of the installed PySide6, from its type stubs; empty without it."""
    try:
        found = importlib.util.find_spec("PySide6")
    except (ImportError, ValueError):
        return frozenset()
    names: set[str] = set()
    for folder in (found.submodule_search_locations or ()) if found else ():
        for module in sorted(PROVIDED):
            with suppress(OSError, UnicodeDecodeError):
                stub = Path(folder, f"{module}.pyi").read_text("utf-8")
                names |= set(_DECLARED_CLASS.findall(stub))
    return frozenset(names)


def _as(alias: ast.alias) -> str:
    return alias.name + (f" as {alias.asname}" if alias.asname else "")
