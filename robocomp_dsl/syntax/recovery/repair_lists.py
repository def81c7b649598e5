"""Repairs of lists of values: brackets, which DDSL writes as braces, and a missing comma.

In: the context of a syntax error. Out: possible repairs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext
from robocomp_dsl.syntax.recovery.repair import Repair

_STRING = r'"[^"\\\n]*(?:\\.[^"\\\n]*)*"'
_VALUE = re.compile(
    rf"\s*(?:(?P<STRING>{_STRING})|(?P<NUMBER>[+-]?[\d.][\w.+-]*)|(?P<ID>[A-Za-z_]\w*))\s*(,|\Z)"
)


def list_mistakes(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """All of them; none for languages without lists of values."""
    if context.tables.language in ("pdsl", "ddsl"):
        yield from _list_in_brackets(context, accepted)
        yield from _missing_comma(context, accepted)


def _missing_comma(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`{1 2}`."""
    token, previous = context.lookahead[0], context.previous
    if "COMMA" in accepted and {token.kind, previous.kind} <= {"NUMBER", "STRING"}:
        at = previous.end
        yield Repair(
            codes.MISSING_PUNCTUATION,
            at,
            at,
            f"`,` is missing after `{previous.text}`",
            title="add `,`",
            edits=((at, at, ","),),
            replacement=(Token("COMMA", ",", at, at),),
            required=1,
        )


def _list_in_brackets(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`set weights = [1.0, 2.0];`."""
    token = context.lookahead[0]
    values = _values(token) if token.kind == "BRACKETED" else None
    if values is None or not {"LBRACE", "STRING"}.issubset(accepted):
        return
    written = f"{{{token.text[1:-1].strip()}}}"
    first, last = token.start, token.end
    yield Repair(
        codes.UNEXPECTED,
        first,
        last,
        "the values of a list are written in braces",
        title=f"write `{written}`",
        edits=((first, last, written),),
        replacement=(
            Token("LBRACE", "{", first, first + 1),
            *values,
            Token("RBRACE", "}", last - 1, last),
        ),
        skip=1,
        required=1,
    )


def _values(token: Token) -> list[Token] | None:
    """The tokens between the brackets; None if these are no values."""
    text, at = token.text[:-1], 1
    tokens: list[Token] = []
    while text[at:].strip():
        match = _VALUE.match(text, at)
        kind = match and next((k for k in ("STRING", "NUMBER", "ID") if match[k]), None)
        if match is None or not kind:
            return None
        if tokens:
            tokens.append(Token("COMMA", ",", token.start + at - 1, token.start + at))
        start, end = (token.start + offset for offset in match.span(kind))
        tokens.append(Token(kind, match[kind], start, end))
        at = match.end()
    return tokens
