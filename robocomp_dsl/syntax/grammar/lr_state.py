"""The stack of an LR parser, and what happens to it when a rule is complete.

In: tables, a builder, the tokens. Out: the values that the builder makes, on the stack.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.node import Node
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Lexer, Token
from robocomp_dsl.syntax.grammar.tables import Rule, Tables
from robocomp_dsl.syntax.grammar.token_stream import TokenStream
from robocomp_dsl.syntax.languages.builder import Builder

RECENT_TOKENS = 64
"""Number of shifted tokens that recovery can read again."""

StackEntry: TypeAlias = tuple[int, Any, int, int]
"""State, value of the symbol that led to it, and the range [start, end) of that symbol."""


_Pick: TypeAlias = tuple[int, Callable[[Token], Node] | None, bool]
"""A child: the index of its symbol (-1: absent), the function that builds a node of a token, and
whether it is a list whose items are the children."""

Reduction: TypeAlias = tuple[str, int, bool, Callable[..., Any] | None, list[_Pick]]
"""A rule prepared for its builder: its origin and length, whether the only child is the value, the
builder method, and the children to pass to it."""


def prepare_reduction(rule: Rule, builder: Builder) -> Reduction:
    """Prepare `rule` for `builder`."""
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


class ParserState:
    """The stack and tokens of one parser run over one source.

    `recent_tokens` are the tokens that were shifted last. `last_reported_end` is the end of the
    last token before a reported error; `suppressed` counts the follow-on errors since then.
    """

    def __init__(self, tables: Tables, builder: Builder, findings: FileDiagnostics) -> None:
        self._lexer = Lexer(findings.source, tables, findings)
        builder.docs = self._lexer.docs
        self.tables = tables
        self.builder = builder
        self.findings = findings
        self.stream = TokenStream(self._lexer.tokens())
        self.stack: list[StackEntry] = [(0, None, 0, 0)]
        self.recent_tokens: deque[Token] = deque(maxlen=RECENT_TOKENS)
        self.last_reported_end = -1
        self.suppressed = 0
        self._reductions = [prepare_reduction(rule, builder) for rule in tables.rules]

    def reduce(self, number: int, offset: int) -> None:
        """Replace the symbols of rule `number` by its result; an empty result is at `offset`."""
        origin, length, passes, call, picks = self._reductions[number]
        stack = self.stack
        if passes:
            _, value, start, end = stack.pop()
        else:
            symbols = stack[-length:] if length else []
            del stack[len(stack) - length :]
            start, end = (symbols[0][2], symbols[-1][3]) if length else (offset, offset)
            value = _children(picks, symbols)
            if call:
                value = call(Span(self.findings.region, start, end), *value)
        stack.append((self.tables.gotos[stack[-1][0]][origin], value, start, end))

    def resume_after(self, before: Token, suppressed: int | None) -> None:
        """Continue after the token `before`; the innermost list of items is complete up to it.

        `suppressed` is the number of follow-on errors if an error was reported after `before`.
        """
        state, items, start, _ = self.stack[-1]
        self.stack[-1] = (state, items, start, before.end)
        self.recent_tokens.clear()
        self.recent_tokens.append(before)
        self.last_reported_end, self.suppressed = (
            (-1, 0) if suppressed is None else (before.end, suppressed)
        )
        self.stream.reset(self._lexer.tokens(before.end))

    def truncate(self, at: int) -> None:
        """End the file here without reporting missing tokens."""
        self.findings.is_truncated = True
        self.stream.truncate(at)


def _children(picks: list[_Pick], symbols: list[StackEntry]) -> list[Any]:
    children: list[Any] = []
    for index, leaf, spliced in picks:
        if leaf:
            children.append(leaf(symbols[index][1]))
        elif not spliced:
            children.append(symbols[index][1] if index >= 0 else None)
        elif children:
            children += symbols[index][1]
        else:
            # The list of a repetition grows in place: copying it would take quadratic time.
            children = symbols[index][1]
    return children
