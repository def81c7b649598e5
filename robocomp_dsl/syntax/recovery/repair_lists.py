"""Repairs of lists of values in PDSL and DDSL: braces, commas, the places of length and default.

In: the context of a syntax error. Out: possible repairs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext
from robocomp_dsl.syntax.recovery.repair import Repair, missing_sign

_STRING = r'"[^"\\\n]*(?:\\.[^"\\\n]*)*"'
_VALUE = re.compile(
    rf"\s*(?:(?P<STRING>{_STRING})|(?P<NUMBER>[+-]?[\d.][\w.+-]*)|(?P<ID>[A-Za-z_]\w*))\s*(,|\Z)"
)
_LENGTH = re.compile(r"\[[\d\s:]*\]")
_VALUES = ("NUMBER", "STRING", "ID")
_ATTRIBUTES = ("BRACKETED", "NUMBER", "COLON", "LIVE")
"""Tokens behind which a default in braces is too late."""
_ENDS_ELEMENT = frozenset(("COMMA", "RBRACE"))


def list_mistakes(
    context: ErrorContext, accepted: list[str], item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """All of them; none for languages without lists of values."""
    if context.tables.language in ("pdsl", "ddsl"):
        yield from _list_in_brackets(context, accepted)
        yield from _missing_comma(context, accepted)
        yield from _missing_end(context, accepted)
        yield from _missing_braces(context, item, keep)
        yield from _late_length(context, item, keep)
        yield from _late_default(context, item, keep)


def _missing_comma(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`{1 2}`."""
    token, previous = context.lookahead[0], context.previous
    kinds = _VALUES if _ENDS_ELEMENT.issuperset(accepted) else _VALUES[:2]
    if "COMMA" not in accepted or token.kind not in kinds or previous.kind not in kinds:
        return
    if token.text != previous.text:
        yield missing_sign("COMMA", ",", previous, required=1)


def _missing_end(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`{1, 2 [kg]`."""
    token = context.lookahead[0]
    if set(accepted) == _ENDS_ELEMENT and token.kind not in (*_VALUES, *_ENDS_ELEMENT):
        yield missing_sign("RBRACE", "}", context.previous, required=1)


def _missing_braces(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """`weights[2] float 1.0, 2.0;`, also with one of the braces."""
    if context.lookahead[0].kind != "COMMA" or not item or item[-1].kind not in _VALUES[:2]:
        return
    behind = next(
        (i for i, t in enumerate(context.lookahead) if t.kind not in (*_VALUES, "COMMA")), 0
    )
    if not behind:
        return
    first, last, after = item[-1], context.lookahead[behind - 1], context.lookahead[behind]
    is_closed = after.kind == "RBRACE"
    edits = [(first.start, first.start, "{")]
    end = () if is_closed else (Token("RBRACE", "}", last.end, last.end),)
    edits += [] if is_closed else [(last.end, last.end, "}")]
    yield Repair(
        codes.UNEXPECTED,
        first.start,
        last.end,
        "the values of a list are written in braces",
        title="add `{`" if is_closed else "add braces",
        edits=tuple(edits),
        replacement=(
            *item[:-1],
            Token("LBRACE", "{", first.start, first.start),
            first,
            *context.lookahead[:behind],
            *end,
        ),
        skip=behind,
        keep=keep,
        required=1,
    )


def _late_length(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """`weights float [2] {1, 2};`: the length behind the type."""
    if len(item) != 3 or not _leading_list(context.lookahead):
        return
    name, kind, length = item
    if not kind.kind.endswith("_TYPE") or not _LENGTH.fullmatch(length.text):
        return
    gap = length.start - kind.end
    yield Repair(
        codes.UNEXPECTED,
        length.start,
        length.end,
        "the length of a list is written after the name",
        title=f"write `{name.text}{length.text}`",
        edits=((name.end, name.end, length.text), (length.start - gap, length.end, "")),
        replacement=(name, length, kind),
        keep=keep,
        required=1,
    )


def _late_default(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """`weights[2] float [kg] {1, 2};`: in PDSL a default in braces is written behind the type."""
    late = _leading_list(context.lookahead)
    last = _last_of_type(item)
    if not late or not last or context.previous.kind not in _ATTRIBUTES:
        return
    if _LENGTH.fullmatch(context.previous.text):
        return
    start, end = late[0].start, late[-1].end
    at = item[last].end
    text = context.source.text
    gap = len(text[:start]) - len(text[:start].rstrip())
    yield Repair(
        codes.UNEXPECTED,
        start,
        end,
        "the default of a list is written behind the type",
        title=f"write it behind `{item[last].text}`",
        edits=((at, at, f" {text[start:end]}"), (start - gap, end, "")),
        replacement=(*item[: last + 1], *late, *item[last + 1 :]),
        skip=len(late),
        keep=keep,
        required=1,
    )


def _leading_list(tokens: Sequence[Token]) -> list[Token]:
    """The tokens of a list in braces at the start of `tokens`; empty if there is none."""
    if not tokens or tokens[0].kind != "LBRACE":
        return []
    for index, token in enumerate(tokens):
        if token.kind == "RBRACE":
            return list(tokens[: index + 1])
        if index and token.kind not in (*_VALUES, "COMMA"):
            return []
    return []


def _last_of_type(item: Sequence[Token]) -> int:
    """The index of the last token of the type of a parameter; 0 if it has a default in braces."""
    kinds = [token.kind for token in item]
    last = 2 if kinds[1:2] == ["BRACKETED"] else 1
    if kinds[:1] != ["ID"] or len(kinds) <= last:
        return 0
    if kinds[last] == "LBRACE":
        if "RBRACE" not in kinds:
            return 0
        last = kinds.index("RBRACE")
    return 0 if kinds[last + 1 : last + 2] == ["LBRACE"] else last


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
