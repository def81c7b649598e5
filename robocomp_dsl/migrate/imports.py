"""Import statements of old Python modules, and what replaces them.

In: a module of the user, the names that can be imported. Out: changes of its text; findings about
what was adapted, and about what only Qt or Ice can give.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.upkeep.user_module import UserModule
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.legacy import STAND_INS
from robocomp_dsl.source import Span

OURS = ("genericworker", "interfaces")
"""Modules that RoboComp generated beside the worker."""
QT = ("PySide", "PySide2", "PySide6", "PyQt4", "PyQt5", "PyQt6")
TIMER = "QTimer()"
"""Code that makes timers of its own, which nothing runs."""
Change = tuple[int, int, str]
"""Put the text in the place [start, end)."""


@dataclass(frozen=True, slots=True)
class Names:
    """What can be imported: the module for old names, the modules of interfaces, the handlers.

    `states` are those of the state machine, as their methods end; None without a machine.
    """

    legacy: str
    modules: frozenset[str]
    handlers: Mapping[str, str]
    states: frozenset[str] | None = None


def _used(tree: ast.Module) -> dict[str, set[str]]:
    """For each name, the attributes that are taken of it; calls are `()` and `attribute()`."""
    found: dict[str, set[str]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found.setdefault(node.value.id, set()).add(node.attr)
        elif isinstance(node, ast.Name):
            found.setdefault(node.id, set())
        elif isinstance(node, ast.Call):
            _add_call(node.func, found)
    return found


def _add_call(function: ast.expr, found: dict[str, set[str]]) -> None:
    if isinstance(function, ast.Name):
        found.setdefault(function.id, set()).add("()")
    elif isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
        found.setdefault(function.value.id, set()).add(f"{function.attr}()")


def adapted_imports(user: UserModule, names: Names, report: Report) -> Iterator[Change]:
    """The changes of all import statements that bring names of RoboComp, Ice or Qt."""
    used = _used(user.tree)
    for node in ast.walk(user.tree):
        if isinstance(node, ast.Import):
            new = _plain_import(node, names, used)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            new = _from_import(node, names, used)
        else:
            continue
        span = span_of(user, node)
        if new is not None:
            if isinstance(node, ast.ImportFrom) and (missing := _beyond(node, user, used)):
                report.add(codes.NEEDS_QT, span, f"there is no {missing} without Qt and Ice")
            report.add(codes.CARRIED_OVER, span, f"`{span.text:.80}` became `{new:.80}`")
            yield span.start, span.end, new
        elif (missing := _missing(node, used)) is not None:
            report.add(codes.NEEDS_QT, span, f"`{span.text:.80}` stays, for {missing}")


def _plain_import(node: ast.Import, names: Names, used: dict[str, set[str]]) -> str | None:
    """The statements for `import a, b as c`; None if nothing of it is ours."""
    made = []
    changed = False
    for alias in node.names:
        bound = alias.asname or alias.name
        ours = alias.name in OURS
        given = alias.name in names.modules or (
            alias.name == "Ice" and _lacking("Ice", bound, used) is None
        )
        changed = changed or ours or given
        suffix = f" as {alias.asname}" if alias.asname else ""
        if ours:
            made.append(f"import {names.legacy} as {bound}")
        elif given:
            made.append(f"from {names.legacy} import {alias.name}{suffix}")
        else:
            made.append(f"import {alias.name}{suffix}")
    return "; ".join(made) if changed else None


def _from_import(node: ast.ImportFrom, names: Names, used: dict[str, set[str]]) -> str | None:
    """The statement for `from a import b`; None if it is not ours."""
    module = node.module or ""
    listed = ", ".join(a.name + (f" as {a.asname}" if a.asname else "") for a in node.names)
    if module in OURS:
        return f"from {names.legacy} import {listed}"
    if module in names.modules:
        return f"from generated.interfaces import {listed}"
    if module.partition(".")[0] in QT and _qt_missing(node, used) is None:
        kept = [a for a in node.names if a.name in STAND_INS]
        listed = ", ".join(a.name + (f" as {a.asname}" if a.asname else "") for a in kept)
        return f"from {names.legacy} import {listed}" if kept else "pass"
    return None


def _beyond(node: ast.ImportFrom, user: UserModule, used: dict[str, set[str]]) -> str | None:
    """What code takes of the names that `from genericworker import *` brought, and is not there."""
    if node.module not in OURS or node.names[0].name != "*":
        return None
    found = [alias for one in ast.walk(user.tree) for alias in getattr(one, "names", [])]
    others = {a.asname or a.name for a in found if isinstance(a, ast.alias)}
    for name in sorted(STAND_INS.keys() - others):
        if missing := _lacking(name, name, used):
            return missing
    return None


def _qt_missing(node: ast.ImportFrom, used: dict[str, set[str]]) -> str | None:
    """What an import from Qt gives that there is no stand-in for."""
    for alias in node.names:
        bound = alias.asname or alias.name
        if alias.name in STAND_INS:
            if missing := _lacking(alias.name, bound, used):
                return missing
        elif alias.name == "*" or bound in used:
            return f"`{alias.name}`"
    return None


def _lacking(name: str, bound: str, used: dict[str, set[str]]) -> str | None:
    """What code takes of the stand-in `name`, which it calls `bound`, and is not there."""
    known, taken = STAND_INS[name], used.get(bound, set())
    if TIMER in (f"{name}()" if "()" in taken else "", *taken):
        return f"`{TIMER}`"
    extra = {one.removesuffix("()") for one in taken if one != "()"} - known
    return f"`{name}.{min(extra)}`" if extra else None


def _missing(node: ast.Import | ast.ImportFrom, used: dict[str, set[str]]) -> str | None:
    """Why an import of Qt or Ice was left as it is; None for one of something else."""
    if isinstance(node, ast.ImportFrom):
        is_qt = (node.module or "").partition(".")[0] in QT
        return _qt_missing(node, used) if is_qt else None
    for alias in node.names:
        if alias.name.partition(".")[0] in QT:
            return "a module of Qt"
        if alias.name == "Ice":
            return _lacking("Ice", alias.asname or alias.name, used)
    return None


def span_of(user: UserModule, node: ast.stmt | ast.expr) -> Span:
    """Where a piece of the tree stands."""
    start = user.offset(node.lineno, node.col_offset)
    return user.source.span(start, user.offset(node.end_lineno or 1, node.end_col_offset or 0))
