"""Values of attributes: checks for new ones, and their texts in a file.

In: a value and the kind of its attribute (`check.innermodel.tags`). Out: the value as the reader
would return it, or the text that the reader reads as this value.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

from robocomp_dsl.check.innermodel.tags import (
    ANGLE_LIMIT,
    EXTENT,
    FLAG,
    LENGTH_LIMIT,
    LENGTHS,
    LIMIT,
    SCALE,
    TEXT,
    UNITS,
    WHOLE,
    Kind,
)
from robocomp_dsl.innermodel.errors import InnerModelError

_ESCAPES = {
    "&": "&amp;",
    "<": "&lt;",
    ">": "&gt;",
    "\t": "&#9;",
    "\n": "&#10;",
    "\r": "&#13;",
}
"""`&` is first: the others contain it."""
_NOT_IN_XML = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_EXACT = 1e15
"""Integers below this are written without an exponent."""


def checked_value(name: str, value: Any, kind: Kind) -> object:
    """The value of a new attribute. Raises `InnerModelError`."""
    if isinstance(kind, tuple):
        if value not in kind:
            words = ", ".join(f"`{word}`" for word in kind)
            raise InnerModelError(f"`{name}` is one of {words}, not {value!r:.80}")
        return value
    if kind == TEXT:
        return checked_text(name, value)
    if kind == FLAG:
        return bool(value)
    if kind in (EXTENT, SCALE):
        if not isinstance(value, Sequence) or len(value) != 3:
            raise InnerModelError(f"`{name}` has three numbers, not {value!r:.80}")
        return tuple(_number(name, part, kind) for part in value)
    found = _number(name, value, kind)
    if kind != WHOLE:
        return found
    if not found.is_integer():
        raise InnerModelError(f"`{name}` is an integer, not {value!r:.80}")
    return int(found)


def checked_text(name: str, value: Any) -> str:
    """A text as it is read again: XML has no control characters, and readers strip white space."""
    text = str(value).strip()
    if found := _NOT_IN_XML.search(text):
        raise InnerModelError(f"`{name}` has the character {found[0]!a}, which XML does not have")
    return text


def _number(name: str, value: Any, kind: Kind) -> float:
    try:
        found = float(value)
    except (TypeError, ValueError):
        raise InnerModelError(f"`{name}` is {kind}, not {value!r:.80}") from None
    endless = math.isinf(found) and kind in (LIMIT, ANGLE_LIMIT, LENGTH_LIMIT)
    if not math.isfinite(found) and not endless:
        raise InnerModelError(f"`{name}` is {found}, it must be a finite number")
    return found


def text_of(value: Any, kind: Kind, written: str = "") -> str:
    """The text of a value; it keeps the unit of `written`, if that reads as exactly this value."""
    if isinstance(value, tuple):
        return ",".join(number_text(part) for part in value)
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, str):
        return value
    return _with_unit(float(value), kind, written) or number_text(value)


def _with_unit(value: float, kind: Kind, written: str) -> str:
    units = UNITS.get(kind, {}) if kind != LENGTHS else {}
    text = written.strip()
    unit = next((u for u in sorted(units, key=len, reverse=True) if text.endswith(u)), "")
    if not unit or not math.isfinite(value):
        return ""
    for digits in (12, 15, 17):
        shown = number_text(float(f"{value / units[unit]:.{digits}g}"))
        if float(shown) * units[unit] == value:
            space = " " if text[: -len(unit)].endswith(" ") else ""
            return f"{shown}{space}{unit}"
    return ""


def number_text(value: float) -> str:
    """The shortest text that reads as this number."""
    number = float(value)
    if number.is_integer() and abs(number) < _EXACT:
        return str(int(number))
    return repr(number)


def escaped(text: str, quote: str = '"') -> str:
    """The text inside an attribute with these quotes."""
    for character, entity in _ESCAPES.items():
        text = text.replace(character, entity)
    return text.replace(quote, "&quot;" if quote == '"' else "&apos;")
