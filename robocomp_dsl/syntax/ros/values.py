"""Values of constants and defaults in ROS definitions.

In: the text of a value and the type of its field. Out: literals of the tree.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Bool, Literal, Name, Number, Text

_INTEGER = re.compile(r"[+-]?(?:0[xX][0-9a-fA-F]+|0[bB][01]+|0[oO][0-7]+|[0-9]+)")
_FLOAT = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_ESCAPE = re.compile(r"\\(.)")
_ITEM = re.compile(r"""\s*("(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'|[^,]*)\s*(?:,|$)""")
_MAX_DIGITS = 100
_BOOLS = {"true": True, "false": False}
_NUMERIC_BOOLS = {"1": True, "0": False}


def parse_value(span: Span, type_: str) -> Literal | None:
    """The value in `span` for a field of `type_`; None if there is none."""
    span = _stripped(span)
    text = span.text
    if type_ == "string":
        return Text(span, _unquoted(text))
    if not text:
        return None
    bools = _BOOLS | _NUMERIC_BOOLS if type_ == "bool" else _BOOLS
    if text.lower() in bools:
        return Bool(span, bools[text.lower()])
    if _INTEGER.fullmatch(text) and len(text) <= _MAX_DIGITS:
        prefixed = text.lstrip("+-")[:2].lower() in ("0x", "0b", "0o")
        return Number(span, int(text, 0) if prefixed else int(text))
    if _FLOAT.fullmatch(text):
        return Number(span, float(text))
    return Name(span, text)


def parse_items(span: Span, type_: str) -> tuple[Literal, ...] | None:
    """The values in brackets; an empty tuple for an empty text, None for anything else."""
    span = _stripped(span)
    text = span.text
    if not text:
        return ()
    if not (text.startswith("[") and text.endswith("]")):
        return None
    values = [
        parse_value(item, type_) for item in _items(span.subspan(span.start + 1, span.end - 1))
    ]
    return None if None in values else tuple(value for value in values if value is not None)


def _items(inside: Span) -> Iterator[Span]:
    at, text = 0, inside.text
    while text[at:].strip():
        found = _ITEM.match(text, at)
        if found is None:
            return
        yield inside.subspan(inside.start + found.start(1), inside.start + found.end(1))
        at = found.end()


def _stripped(span: Span) -> Span:
    text = span.text
    start = span.start + len(text) - len(text.lstrip())
    return span.subspan(start, start + len(text.strip()))


def _unquoted(text: str) -> str:
    is_quoted = len(text) > 1 and text[0] in "\"'" and text[-1] == text[0]
    return _ESCAPE.sub(r"\1", text[1:-1]) if is_quoted else text
