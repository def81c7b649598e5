"""The user's Python of an old component, made to run on the new one.

In: a module as the user wrote it. Out: the same text with other import statements (what RoboComp
generated or brought along comes from `legacy`), and the methods of very old components under the
names of today; every other byte stays. Findings say what was adapted and what may not run.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.component_names import modules_of, names_of
from robocomp_dsl.generate.names import COMPONENT_MEMBERS
from robocomp_dsl.generate.upkeep.user_module import UserModule
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.legacy import STAND_INS
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Span

OURS = ("genericworker", "interfaces")
"""Modules that RoboComp generated beside the worker."""
QT = ("PySide", "PySide2", "PySide6", "PyQt4", "PyQt5", "PyQt6")
TIMER = "QTimer()"
"""Code that makes timers of its own, which nothing runs."""
HOOKS = {"initialize", "compute", "emergency", "restore", "finalize"}

Change = tuple[int, int, str]
"""Put the text in the place [start, end)."""


@dataclass(frozen=True, slots=True)
class Names:
    """What can be imported: the module for old names, the modules of interfaces, the handlers."""

    legacy: str
    modules: frozenset[str]
    handlers: Mapping[str, str]
    has_states: bool = False


def names_for(component: Component, legacy: str) -> Names:
    """The names of one component; `handlers` has the old bare name of each method."""
    called = names_of(component)
    handlers = {operation.name: name for (_, operation), name in called.handlers.items()}
    modules = frozenset(one.name for one in modules_of(component))
    return Names(legacy, modules, handlers, component.statemachine is not None)


def adapted(user: UserModule, names: Names, report: Report) -> str:
    """The text of `user` for the new component."""
    used = _attributes_used(user.tree)
    changes = list(_imports(user, names, used, report))
    if user.worker is not None:
        changes += _aliases(user, names)
        _judge_names(user, user.worker, report)
        _judge_states(user, user.worker if names.has_states else None, report)
    text = user.source.text
    for start, end, new in sorted(changes, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def period_of(user: UserModule) -> tuple[int, Span] | None:
    """The whole number that the worker assigns to `self.Period`, in ms, and where."""
    found = None
    for node in ast.walk(user.worker) if user.worker else ():
        if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Constant):
            continue
        target, value = node.targets[0], node.value.value
        named = isinstance(target, ast.Attribute) and target.attr == "Period"
        if named and type(value) is int and 0 < value < 10**7 and found is None:
            found = (value, _span(user, node))
    return found


def _span(user: UserModule, node: ast.stmt | ast.expr) -> Span:
    start = user.offset(node.lineno, node.col_offset)
    return user.source.span(start, user.offset(node.end_lineno or 1, node.end_col_offset or 0))


def _attributes_used(tree: ast.Module) -> dict[str, set[str]]:
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


def _imports(
    user: UserModule, names: Names, used: dict[str, set[str]], report: Report
) -> Iterator[Change]:
    for node in ast.walk(user.tree):
        if isinstance(node, ast.Import):
            new = _plain_import(node, names, used)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            new = _from_import(node, names, used)
        else:
            continue
        span = _span(user, node)
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


def _aliases(user: UserModule, names: Names) -> Iterator[Change]:
    """Before 2019 a method was called as its operation; today's name is added behind them."""
    worker = user.worker
    defined = worker.body if worker else []
    members = {one.name for one in defined if isinstance(one, ast.FunctionDef)}
    assigned = (t for one in defined if isinstance(one, ast.Assign) for t in one.targets)
    members |= {one.id for one in assigned if isinstance(one, ast.Name)}
    wanted = [
        (new, old)
        for old, new in names.handlers.items()
        if old in members and new not in members and old not in HOOKS
    ]
    if not wanted or worker is None:
        return
    last, first = worker.body[-1], worker.body[0]
    text, start = user.source.text, user.starts[first.lineno - 1]
    end = user.offset(last.end_lineno or 1, last.end_col_offset or 0)
    end += len(text[end:].partition("\n")[0].rstrip("\r"))
    indent = text[start : user.offset(first.lineno, first.col_offset)]
    line_end = "\r\n" if "\r\n" in text else "\n"
    rows = [f"{indent}{new} = {old}" for new, old in wanted]
    yield end, end, line_end + line_end + line_end.join(rows)


def _judge_names(user: UserModule, worker: ast.ClassDef, report: Report) -> None:
    taken = COMPONENT_MEMBERS - HOOKS
    for node in ast.walk(worker):
        if not isinstance(node, ast.Attribute) or not isinstance(node.ctx, ast.Store):
            continue
        if isinstance(node.value, ast.Name) and node.value.id == "self" and node.attr in taken:
            said = f"`self.{node.attr}` belongs to the component; call yours otherwise"
            report.add(codes.NAME_TAKEN, _span(user, node), said)


def _judge_states(user: UserModule, worker: ast.ClassDef | None, report: Report) -> None:
    """Tell the methods and events of a state machine of old."""
    for node in ast.walk(worker) if worker else ():
        if isinstance(node, ast.FunctionDef) and node.name.startswith("sm_"):
            new = f"on_enter_{node.name.removeprefix('sm_')}"
            said = f"`{node.name}` is called by nothing; its name is `{new}` now"
            report.add(codes.STATE_METHOD, user.span_of(node), said)
