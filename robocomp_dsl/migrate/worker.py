"""Adapt the user's Python code of an old component.

In: a module of the user. Out: the same text with adapted import statements (names that RoboComp
generated come from `legacy`) and aliases for the method names of components before 2019; every
other byte is unchanged. Findings list the adaptations and code that may not run.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.names import COMPONENT_MEMBERS
from robocomp_dsl.generate.python.component_names import modules_of, names_of
from robocomp_dsl.generate.regeneration.python_module import end_of_comments
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.imports import LegacyNames, TextEdit, adapt_imports, span_of
from robocomp_dsl.migrate.legacy import states_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Span

HOOKS = {"initialize", "compute", "emergency", "restore", "finalize"}


def names_for(component: Component, legacy: str) -> LegacyNames:
    """The names of a component; `handlers` maps each old method name to the current one."""
    called = names_of(component)
    handlers = {operation.name: name for (_, operation), name in called.handlers.items()}
    modules = frozenset(module.name for module in modules_of(component))
    states = frozenset(states_of(component)) if component.statemachine else None
    servants = frozenset(
        ["commonbehaviorI", *(f"{port.interface.name.lower()}I" for port in component.ports)]
    )
    return LegacyNames(
        legacy, called.package, modules, handlers, states, servants, has_window=bool(component.gui)
    )


def adapt_module(user: UserModule, names: LegacyNames, report: Report, first_line: str = "") -> str:
    """The adapted text of `user`; `first_line` is inserted before its first statement."""
    changes = list(adapt_imports(user, names, report))
    if first_line:
        changes.append(_first_line_edit(user, first_line))
    if user.worker is not None:
        changes += _handler_aliases(user, names)
        _check_attribute_names(user, user.worker, report)
        if names.states is not None:
            _check_state_methods(user, user.worker, names.states, report)
    text = user.source.text
    for start, end, new in sorted(changes, key=lambda edit: edit[:2], reverse=True):
        text = text[:start] + new + text[end:]
    return text


def _first_line_edit(user: UserModule, line: str) -> TextEdit:
    """Insert a line before the first statement that is no docstring and no `__future__`."""
    at = 0
    for statement in user.tree.body:
        is_doc = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
        is_future = isinstance(statement, ast.ImportFrom) and statement.module == "__future__"
        if not is_doc and not is_future:
            at = user.starts[statement.lineno - 1]
            break
    line_end = "\r\n" if "\r\n" in user.source.text else "\n"
    return at, at, f"{line}{line_end}"


def period_of(user: UserModule) -> tuple[int, Span] | None:
    """The integer that the worker assigns to `self.Period` [ms], and its position."""
    period = None
    for node in ast.walk(user.worker) if user.worker else ():
        if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Constant):
            continue
        target, value = node.targets[0], node.value.value
        named = isinstance(target, ast.Attribute) and target.attr == "Period"
        if named and type(value) is int and 0 < value < 10**7 and period is None:
            period = (value, span_of(user, node))
    return period


def _handler_aliases(user: UserModule, names: LegacyNames) -> Iterator[TextEdit]:
    """Before 2019 methods were named like operations; append aliases with the current names."""
    worker = user.worker
    defined = worker.body if worker else []
    members = {statement.name for statement in defined if isinstance(statement, ast.FunctionDef)}
    assigned = (
        t for statement in defined if isinstance(statement, ast.Assign) for t in statement.targets
    )
    members |= {statement.id for statement in assigned if isinstance(statement, ast.Name)}
    aliases = [
        (new, old)
        for old, new in names.handlers.items()
        if old in members and new not in members and old not in HOOKS
    ]
    if not aliases or worker is None:
        return
    last, first = worker.body[-1], worker.body[0]
    text, start = user.source.text, user.starts[first.lineno - 1]
    end = user.offset(last.end_lineno or 1, last.end_col_offset or 0)
    indent = text[start : user.offset(first.lineno, first.col_offset)]
    end = end_of_comments(text, end, indent)
    line_end = "\r\n" if "\r\n" in text else "\n"
    rows = [f"{indent}{new} = {old}" for new, old in aliases]
    yield end, end, line_end + line_end + line_end.join(rows)


def _check_attribute_names(user: UserModule, worker: ast.ClassDef, report: Report) -> None:
    taken = COMPONENT_MEMBERS - HOOKS
    for node in ast.walk(worker):
        if not isinstance(node, ast.Attribute) or not isinstance(node.ctx, ast.Store):
            continue
        if isinstance(node.value, ast.Name) and node.value.id == "self" and node.attr in taken:
            message = f"`self.{node.attr}` belongs to the component; rename your attribute"
            report.add(codes.NAME_TAKEN, span_of(user, node), message)


def _check_state_methods(
    user: UserModule, worker: ast.ClassDef, states: frozenset[str], report: Report
) -> None:
    """Report the methods of the old state machine, and how they are called now."""
    for node in ast.walk(worker):
        if not isinstance(node, ast.FunctionDef) or not node.name.startswith("sm_"):
            continue
        state = node.name.removeprefix("sm_")
        if state in states:
            message = f"`{node.name}` is now named `on_enter_{state}`; `legacy.py` still calls it"
            report.add(codes.LEGACY_STATE_METHOD, user.span_of(node), message)
        else:
            message = f"`{node.name}` is never called: there is no state `{state}`"
            report.add(codes.UNKNOWN_STATE_METHOD, user.span_of(node), message)
