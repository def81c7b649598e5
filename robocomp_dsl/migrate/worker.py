"""The user's Python of an old component, made to run on the new one.

In: a module as the user wrote it. Out: the same text with other import statements (what RoboComp
generated or brought along comes from `legacy`), and the methods of very old components under the
names of today; every other byte stays. Findings say what was adapted and what may not run.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.component_names import modules_of, names_of
from robocomp_dsl.generate.names import COMPONENT_MEMBERS
from robocomp_dsl.generate.upkeep.user_module import UserModule
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.imports import Change, Names, adapted_imports, span_of
from robocomp_dsl.migrate.legacy import states_of
from robocomp_dsl.model.component import Component
from robocomp_dsl.source import Span

HOOKS = {"initialize", "compute", "emergency", "restore", "finalize"}


def names_for(component: Component, legacy: str) -> Names:
    """The names of one component; `handlers` has the old bare name of each method."""
    called = names_of(component)
    handlers = {operation.name: name for (_, operation), name in called.handlers.items()}
    modules = frozenset(one.name for one in modules_of(component))
    states = frozenset(states_of(component)) if component.statemachine else None
    return Names(legacy, modules, handlers, states)


def adapted(user: UserModule, names: Names, report: Report) -> str:
    """The text of `user` for the new component."""
    changes = list(adapted_imports(user, names, report))
    if user.worker is not None:
        changes += _aliases(user, names)
        _judge_names(user, user.worker, report)
        if names.states is not None:
            _judge_states(user, user.worker, names.states, report)
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
            found = (value, span_of(user, node))
    return found


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
            report.add(codes.NAME_TAKEN, span_of(user, node), said)


def _judge_states(
    user: UserModule, worker: ast.ClassDef, states: frozenset[str], report: Report
) -> None:
    """Tell the methods of a state machine of old: who calls them now, if anybody does."""
    for node in ast.walk(worker):
        if not isinstance(node, ast.FunctionDef) or not node.name.startswith("sm_"):
            continue
        state = node.name.removeprefix("sm_")
        if state in states:
            said = f"`{node.name}` is called `on_enter_{state}` now; `legacy.py` calls it still"
            report.add(codes.STATE_CALLED, user.span_of(node), said)
        else:
            said = f"nobody calls `{node.name}`: there is no state `{state}`"
            report.add(codes.STATE_METHOD, user.span_of(node), said)
