"""Checks the events and states in the user's code against the state machine.

In: the user's module, the machine of the component. Out: findings about
`self.machine.send("x")` and `self.machine.is_in("x")` where there is no such event or state.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator

from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.python.machine_code import MachineCode
from robocomp_dsl.generate.regeneration.user_module import UserModule

_KIND_OF_ARGUMENT = {"send": "event", "go": "event", "is_in": "state"}


def report_unknown_events(user: UserModule, machine: MachineCode | None, report: Report) -> None:
    """Check the user's class and its bases in the same folder."""
    known = {
        "event": machine.events if machine else (),
        "state": tuple(m.state.name for m in machine.of_verb("state")) if machine else (),
    }
    for module, class_ in user.hierarchy.classes:
        for what, name, node in _named(class_):
            if (what == "event" and _takes(name, known[what])) or name in known[what]:
                continue
            end = module.offset(node.end_lineno or node.lineno, node.end_col_offset or 0)
            start = module.offset(node.lineno, node.col_offset)
            missing = f"there is no {what} `{name}`" if machine else "there is no state machine"
            report.add(
                codes.UNKNOWN_EVENT,
                module.source.span(start, end),
                missing,
                label=did_you_mean(name, known[what]),
                help=_help(what, known[what]),
            )


def _named(class_: ast.ClassDef) -> Iterator[tuple[str, str, ast.Constant]]:
    """The name, the method, and the location; only string literals are checked."""
    for node in ast.walk(class_):
        match node:
            case ast.Call(
                func=ast.Attribute(
                    value=ast.Attribute(value=ast.Name(id="self"), attr="machine"), attr=method
                ),
                args=[ast.Constant(value=str(name)) as text, *_],
            ) if method in _KIND_OF_ARGUMENT:
                yield _KIND_OF_ARGUMENT[method], name, text


def _takes(event: str, known: Collection[str]) -> bool:
    """Whether an event of the machine is this one, or a pattern that matches it (SCXML 3.12.1)."""
    heads = [name.removesuffix("*").removesuffix(".") for name in known]
    return "*" in known or any(event == head or event.startswith(f"{head}.") for head in heads)


def _help(what: str, known: Collection[str]) -> str:
    shown = ", ".join(f"`{name}`" for name in sorted(known)[:8])
    return f"{what}s are {shown}{', …' if len(known) > 8 else ''}" if known else ""
