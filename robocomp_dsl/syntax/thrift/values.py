"""Values of constants and defaults in Thrift definitions.

In: tokens. Out: a literal of the tree; a list or map has none.
"""

from __future__ import annotations

import re

from robocomp_dsl.record import Record
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Bool, Literal, Name, Number, Text
from robocomp_dsl.syntax.thrift.cursor import Cursor
from robocomp_dsl.syntax.thrift.tokens import NUMBER, TEXT, WORD, ThriftToken

_ESCAPE = re.compile(r"\\(.)")
_CONTROL = {"n": "\n", "t": "\t", "r": "\r"}
_MAX_DIGITS = 100


class Value(Record):
    """A value; `literal` is None for a list or map, which `is_empty` if nothing is in it."""

    span: Span
    literal: Literal | None
    is_empty: bool = False


def read_value(cursor: Cursor, constants: dict[str, Literal]) -> Value:
    """Read a value; names of `constants` stand for theirs. Raises `SyntaxMistake`."""
    token = cursor.token
    if token.kind == TEXT:
        cursor.next()
        return Value(token.span, Text(token.span, _unquoted(token.text)))
    if token.kind == NUMBER and len(token.text) <= _MAX_DIGITS:
        cursor.next()
        return Value(token.span, Number(token.span, _number(token.text)))
    if token.kind == WORD:
        cursor.next()
        return Value(token.span, _named(token, constants))
    if token.text in ("[", "{"):
        return _container(cursor)
    raise cursor.fail("expected a value")


def _number(text: str) -> int | float:
    digits = text.lstrip("+-")
    if digits[:2].lower() == "0x":
        return int(text, 16)
    return int(text) if digits.isdigit() else float(text)


def _named(token: ThriftToken, constants: dict[str, Literal]) -> Literal:
    """A bool, a constant of the file, or the enumerator behind the last dot."""
    span, word = token.span, token.text
    if word.lower() in ("true", "false"):
        return Bool(span, word.lower() == "true")
    known = constants.get(word)
    if known is not None:
        return known.replace(span=span)
    short = word.rpartition(".")[2]
    return Name(span.subspan(span.end - len(short), span.end), short)


def _container(cursor: Cursor) -> Value:
    """Read `[…]` or `{…}` to the bracket that closes it."""
    first = cursor.next()
    closing, is_empty = [{"[": "]", "{": "}"}[first.text]], True
    while closing:
        if cursor.is_at_end:
            cursor.fail(f"expected `{closing[-1]}`")
        token = cursor.next()
        if token.kind != TEXT and token.text == closing[-1]:
            closing.pop()
            continue
        is_empty = False
        if token.kind != TEXT and token.text in ("[", "{"):
            closing.append({"[": "]", "{": "}"}[token.text])
    return Value(first.span.cover(cursor.last.span), None, is_empty)


def _unquoted(text: str) -> str:
    return _ESCAPE.sub(lambda found: _CONTROL.get(found[1], found[1]), text[1:-1])
