"""The LALR parser: tokens in, whatever the builder makes of them out.

It follows the tables as any LR parser does. A keyword is read as a name where no keyword fits, as
with Lark's contextual lexer. What does not fit at all is left to `recovery`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.builder import Builder
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.machine import Machine
from robocomp_dsl.syntax.tables import END, Tables, name_action

if TYPE_CHECKING:
    from robocomp_dsl.syntax.reuse import Reuse

DEEPEST = 400
"""Entries of the stack, about four for a pair of braces: readers of a tree may recurse safely."""


def parse(tables: Tables, builder: Builder, findings: Findings, reuse: Reuse | None = None) -> Any:
    """What the builder makes of the source that the findings are about."""
    machine = Machine(tables, builder, findings)
    stack, trail, take = machine.stack, machine.trail, machine.stream.take
    actions, words = tables.actions, tables.words
    resting = tables.restarts if reuse else frozenset()
    token = take()
    while True:
        row = actions[stack[-1][0]]
        action = row.get(token.kind)
        if action is None and token.kind in words:
            action = name_action(row, token.kind)
        if action is None:
            token = _recover(machine, token)
        elif action < 0:
            machine.reduce(-1 - action, token.start)
            if token.kind == END and stack[-1][0] == tables.accept:
                return stack[-1][1]
            if stack[-1][0] in resting and reuse:
                token = reuse.between_items(machine, token)
        else:
            trail.append(token)
            stack.append((action, token, token.start, token.end))
            if len(stack) > DEEPEST:
                _too_deep(machine, token)
            token = take()


def _recover(machine: Machine, token: Token) -> Token:
    from robocomp_dsl.syntax import recovery  # noqa: PLC0415 - most files need none of it

    machine.stream.put((token,))
    recovery.recover(machine)
    return machine.stream.take()


def _too_deep(machine: Machine, token: Token) -> None:
    """Such a file is garbage; nobody waits for its end."""
    machine.findings.add(
        codes.TOO_DEEP, token.start, token.end, "blocks are nested too deeply to be meant"
    )
    machine.cut(token.start)
