"""Repairs of missing operands: a name, a text or a number was omitted.

In: the context of a syntax error and the tokens since the start of the statement. Out: possible
repairs, the most likely first. A placeholder takes the place of what is missing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair

_BACK = 3
"""The operand is missing at most this many tokens before the unexpected one."""

_PLACEHOLDERS = {"ID": "?", "STRING": '""', "NUMBER": "1"}
_NOUNS = {"ID": "a name", "STRING": 'a "string"', "NUMBER": "a number"}

_DECLARING = frozenset(
    (
        *("module", "struct", "exception", "enum", "interface", ">"),
        *("import", "component", "host", "program", "device", "extern", "group", "as"),
        *("states", "initial_state", "end_state"),
    )
)
"""Words before the name of a declaration, in lower case."""


def missing_operand(context: ErrorContext, accepted: Sequence[str]) -> Iterator[Repair]:
    """`import ;`, `struct { … };`: an operand is missing before the unexpected token."""
    yield from _missing(context, (), 0, accepted)


def missing_operand_before_keyword(
    context: ErrorContext, item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`Idle => on started;`, `implements as other;`: the keyword behind it was read as a name."""
    size = len(item)
    for index in range(size - 1, max(size - _BACK, 0), -1):
        if item[index].kind not in context.tables.keyword_terminals:
            continue
        states = context.states_after(keep, item[:index])
        if states is None:
            continue
        there = context.replace(
            states=states,
            previous=item[index - 1],
            lookahead=(*item[index:], *context.lookahead),
        )
        yield from _missing(there, item[:index], keep, there.accepted_terminals(), size - index)


def _missing(
    context: ErrorContext,
    before: Sequence[Token],
    keep: int,
    accepted: Sequence[str],
    back: int = 0,
) -> Iterator[Repair]:
    """A placeholder before the next token; `back` of the next tokens were read already."""
    token, at = context.lookahead[0], context.previous.end
    if token.kind == "STRAY":
        return
    for kind, text in _PLACEHOLDERS.items():
        if kind not in accepted or token.kind == kind:
            continue
        behind = context.lookahead[:back]
        yield Repair(
            codes.UNEXPECTED,
            token.start if token.kind != END else at,
            token.end if token.kind != END else at,
            f"{_NOUNS[kind]} is missing after {quote_token(context.previous)}",
            replacement=(*before, Token(kind, text, at, at), *behind),
            keep=keep,
            declares=_declares(context, before),
        )


def _declares(context: ErrorContext, before: Sequence[Token]) -> bool:
    """Whether the missing operand is the name of a declaration."""
    first = before[0] if before else context.previous
    return first.text.lower() in _DECLARING or context.previous.text.lower() in _DECLARING
