"""Lists and lengths that are written in brackets.

In: the node of a `[…]`. Out: the values of a list, which PDSL writes in braces; whether the text is
the length of a list.
"""

from __future__ import annotations

import re

from robocomp_dsl.syntax.ast.base import Literal, LiteralList, Name, Number, Text, Unit
from robocomp_dsl.syntax.languages.builder import literal, parse_number

_VALUE = re.compile(
    r'\s*(?:(?P<text>"[^"\\\n]*(?:\\.[^"\\\n]*)*")'
    r"|(?P<number>0[xX][0-9a-fA-F]+|[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?![\w.])"
    r"|(?P<name>[A-Za-z_]\w*))\s*(?:,|\Z)"
)
_LENGTH = re.compile(r"\d*|\d*\s*:\s*\d*")


def is_length(unit: Unit) -> bool:
    """Whether the brackets have a length: `[3]`, `[1:8]`, `[]`."""
    return _LENGTH.fullmatch(unit.text) is not None


def list_in_brackets(unit: Unit) -> LiteralList | None:
    """The values of `[1.0, 2.0]`; None if there is something else between the brackets."""
    items: list[Literal] = []
    text = unit.text
    if text not in unit.span.text:  # a repair added it
        return None
    at = unit.span.start + unit.span.text.index(text)
    position = 0
    while text[position:].strip():
        match = _VALUE.match(text, position)
        kind = match.lastgroup if match else None
        if match is None or kind is None:
            return None
        start, stop = (at + offset for offset in match.span(kind))
        items.append(_node(unit, kind, start, stop, match[kind]))
        position = match.end()
    return LiteralList(unit.span, tuple(items))


def _node(unit: Unit, kind: str, start: int, stop: int, written: str) -> Literal:
    span = unit.span.subspan(start, stop)
    if kind == "number":
        return Number(span, parse_number(written))
    return Text(span, written[1:-1]) if kind == "text" else literal(Name(span, written))
