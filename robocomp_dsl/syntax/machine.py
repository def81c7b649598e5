"""The stack of an LR parser, and what happens to it when a rule is complete.

In: tables, a builder, the tokens. Out: the values that the builder makes, on the stack.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.builder import Builder
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Lexer, Token
from robocomp_dsl.syntax.node import Node
from robocomp_dsl.syntax.stream import Stream
from robocomp_dsl.syntax.tables import Rule, Tables

TRAIL = 64
"""Tokens that are remembered, to be read again in another way."""

Entry: TypeAlias = tuple[int, Any, int, int]
"""State, value of the symbol that led to it, and the characters [start, end) of that symbol."""


_Pick: TypeAlias = tuple[int, Callable[[Token], Node] | None, bool]
"""A child: the index of its symbol (-1: absent), what makes a node of a token, and whether it is a
list whose items are the children."""

Plan: TypeAlias = tuple[str, int, bool, Callable[..., Any] | None, list[_Pick]]
"""A rule made ready for its builder: its origin and length, whether the only child is the value,
what makes the value of the children, and how these are picked."""


def plan(rule: Rule, builder: Builder) -> Plan:
    """The plan of `rule`."""
    return (
        rule.origin,
        rule.length,
        rule.unwraps and rule.length == 1,
        getattr(builder, rule.method) if rule.method else None,
        [
            (pick.symbol, builder.leaf(pick.terminal) if pick.terminal else None, pick.spliced)
            for pick in rule.picks
        ],
    )


class Machine:
    """One run over one source.

    `trail` holds the last tokens that were taken onto the stack. `told_behind` is the end of the
    last token before an error that was reported, `untold` counts errors since then that were not.
    """

    def __init__(self, tables: Tables, builder: Builder, findings: Findings) -> None:
        self._lexer = Lexer(findings.source, tables, findings)
        builder.docs = self._lexer.docs
        self.tables = tables
        self.builder = builder
        self.findings = findings
        self.stream = Stream(self._lexer.tokens())
        self.stack: list[Entry] = [(0, None, 0, 0)]
        self.trail: deque[Token] = deque(maxlen=TRAIL)
        self.told_behind = -1
        self.untold = 0
        self._plans = [plan(rule, builder) for rule in tables.rules]

    def reduce(self, number: int, at: int) -> None:
        """Replace the symbols of rule `number` by the one that it makes; an empty one is `at`."""
        origin, length, passes, call, picks = self._plans[number]
        stack = self.stack
        if passes:
            _, value, start, end = stack.pop()
        else:
            symbols = stack[-length:] if length else []
            del stack[len(stack) - length :]
            start, end = (symbols[0][2], symbols[-1][3]) if length else (at, at)
            value = _children(picks, symbols)
            if call:
                value = call(Span(self.findings.place, start, end), *value)
        stack.append((self.tables.gotos[stack[-1][0]][origin], value, start, end))

    def jump(self, before: Token, untold: int | None) -> None:
        """Go on behind `before`, to which the innermost list of items has been filled up.

        `untold` counts the errors that were not reported where `before` is the last good token.
        """
        state, items, start, _ = self.stack[-1]
        self.stack[-1] = (state, items, start, before.end)
        self.trail.clear()
        self.trail.append(before)
        self.told_behind, self.untold = (-1, 0) if untold is None else (before.end, untold)
        self.stream.go_on_with(self._lexer.tokens(before.end))

    def cut(self, at: int) -> None:
        """Let the file end here, without a word on what is then missing."""
        self.findings.cut = True
        self.stream.cut(at)


def _children(picks: list[_Pick], symbols: list[Entry]) -> list[Any]:
    children: list[Any] = []
    for index, leaf, spliced in picks:
        if leaf:
            children.append(leaf(symbols[index][1]))
        elif not spliced:
            children.append(symbols[index][1] if index >= 0 else None)
        elif children:
            children += symbols[index][1]
        else:
            # The list of a repetition grows in place, or long files would take ages.
            children = symbols[index][1]
    return children
