"""Where in a statement the user is about to type, by the parser's own tables.

In: a text and an offset. Out: a `Cursor`: the words before it and the terminals that may come next.
What stands behind the cursor does not count, and the word that touches it is not there yet.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import recovery
from robocomp_dsl.syntax.builder import Builder
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.machine import Machine
from robocomp_dsl.syntax.situation import Situation
from robocomp_dsl.syntax.tables import END, Tables, load, name_action

_ASIDE = re.compile(r"""//[^\n]*|/\*.*?(?:\*/|\Z)|"[^"\n]*"?""", re.DOTALL)
_WORD = re.compile(r"[A-Za-z_]\w*\Z")
_BRACKET = re.compile(r"\[[^\]\n;{}]*\Z")
_ENDS = frozenset(("_SEMI", "LBRACE", "RBRACE"))


@dataclass(frozen=True, slots=True)
class Cursor:
    """`start` is where the word begins that is being typed.

    `statement` are the tokens since the last `;` or brace, `blocks` those of the statements that
    opened the blocks around it, outermost first. `quoted` and `bracketed` say that a text or a `[`
    is still open.
    """

    path: Path
    source: Source
    offset: int
    start: int
    statement: list[Token]
    blocks: list[list[Token]]
    accepted: frozenset[str]
    tables: Tables
    quoted: bool = False
    bracketed: bool = False

    @property
    def block(self) -> list[Token]:
        """The statement that opened the innermost block, or nothing."""
        return self.blocks[-1] if self.blocks else []

    @property
    def last(self) -> str:
        """Kind of the token before the cursor in this statement, or an empty text."""
        return self.statement[-1].kind if self.statement else ""

    @property
    def inside(self) -> str:
        """Kind of the first token of the innermost block, or an empty text."""
        return self.block[0].kind if self.block else ""


def cursor_at(path: Path, source: Source, offset: int) -> Cursor | None:
    """The cursor at `offset`; None in a comment."""
    before = source.text[:offset]
    aside = next(iter(deque(_ASIDE.finditer(before), maxlen=1)), None)
    quoted = False
    if aside and aside.end() == offset:
        if not aside[0].startswith('"'):
            if aside[0].startswith("//") or not aside[0].endswith("*/"):
                return None
        else:
            quoted = len(aside[0]) == 1 or not aside[0].endswith('"')
    bracket = None if quoted else _BRACKET.search(before)
    word = _WORD.search(before)
    if quoted and aside:
        cut, start = aside.start(), aside.start() + 1
    elif bracket:
        cut, start = bracket.start(), bracket.start() + 1
    else:
        cut = start = word.start() if word else offset
    tables = load(path.suffix[1:].lower())
    statement, blocks, accepted = _read(Source(path, before[:cut]), tables)
    return Cursor(
        path, source, offset, start, statement, blocks, accepted, tables, quoted, bool(bracket)
    )


class _Silent(Builder):
    """Makes nothing: only the parser's states count."""

    def __getattr__(self, name: str) -> Callable[..., list[Any]]:
        return lambda *_: []


def _read(source: Source, tables: Tables) -> tuple[list[Token], list[list[Token]], frozenset[str]]:
    """The current statement, what opened its blocks, and the terminals that fit next."""
    findings = Findings(source, Report())
    machine = Machine(tables, _Silent(findings), findings)
    statement: list[Token] = []
    blocks: list[list[Token]] = []
    stack, take = machine.stack, machine.stream.take
    token = take()
    counted = -1
    while token.kind != END:
        if token.start > counted:
            counted = token.start
            statement = _counted(token, statement, blocks)
        row = tables.actions[stack[-1][0]]
        action = row.get(token.kind)
        if action is None and token.kind in tables.words:
            action = name_action(row, token.kind)
        if action is None:
            machine.stream.put((token,))
            recovery.recover(machine)
            token = take()
        elif action < 0:
            machine.reduce(-1 - action, token.start)
        else:
            machine.trail.append(token)
            stack.append((action, token, token.start, token.end))
            token = take()
    states = [entry[0] for entry in stack]
    # Keywords that would be read as names are none to offer.
    strict = tables.replaced(words=frozenset())
    situation = Situation(strict, source, states, token, (token,), ())
    return statement, blocks, frozenset(situation.accepted())


def _counted(token: Token, statement: list[Token], blocks: list[list[Token]]) -> list[Token]:
    """The statement with `token` in it; braces open and close `blocks`."""
    if token.kind == "LBRACE":
        blocks.append(statement)
    elif token.kind == "RBRACE" and blocks:
        blocks.pop()
    return [] if token.kind in _ENDS else [*statement, token]
