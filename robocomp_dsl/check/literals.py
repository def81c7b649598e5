"""Converts literals to values of a type: defaults of fields and parameters, `set` in deployments.

In: a literal of a tree. Out: the value; raises `TypeMismatch` with a message for the user.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.model import types
from robocomp_dsl.syntax.ast.base import Bool, Literal, Name, Number, Text


class TypeMismatch(Exception):
    """The value has the wrong type; `label` is for the carets, `replacement` is a fix."""

    def __init__(self, message: str, label: str = "", replacement: str | None = None) -> None:
        super().__init__(message)
        self.label = label
        self.replacement = replacement


class OutOfRange(TypeMismatch):
    """The type is right, the value is out of range."""


def as_bool(literal: Literal) -> bool:
    """`true` or `false`."""
    if isinstance(literal, Bool):
        return literal.value
    if isinstance(literal, Name) and literal.text.lower() in ("true", "false"):
        return literal.text.lower() == "true"
    raise TypeMismatch(f"{_describe(literal)}, but a `bool` is `true` or `false`")


def as_int(literal: Literal, bits: int = 64, *, unsigned: bool = False) -> int:
    """A whole number that fits into an integer of `bits` bits."""
    if not isinstance(literal, Number):
        raise TypeMismatch(f"{_describe(literal)}, not a whole number")
    if isinstance(literal.value, float) and not literal.value.is_integer():
        raise TypeMismatch(f"`{literal.span.text}` is not an integer")
    low, high = (0, (1 << bits) - 1) if unsigned else (-(1 << (bits - 1)), (1 << (bits - 1)) - 1)
    if not low <= literal.value <= high:
        raise OutOfRange(f"`{literal.span.text}` is outside {low} to {high}")
    return int(literal.value)


def as_float(literal: Literal) -> float:
    """A finite number."""
    if not isinstance(literal, Number):
        raise TypeMismatch(f"{_describe(literal)}, not a number")
    try:
        value = float(literal.value)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value):
        raise OutOfRange(f"`{literal.span.text}` is too large for a number with a fraction")
    return value


def as_string(literal: Literal) -> str:
    """A string in quotes."""
    if isinstance(literal, Text):
        return literal.value
    written = literal.span.text
    raise TypeMismatch(f"{_describe(literal)}, not a string in quotes", replacement=f'"{written}"')


def _as_bounded_string(literal: Literal, bound: int) -> str:
    """A string in quotes of at most `bound` bytes of UTF-8, if that is not 0."""
    text = as_string(literal)
    if bound and len(text.encode()) > bound:
        raise OutOfRange(f"`{literal.span.text}` is longer than {bound} bytes")
    return text


def as_choice(literal: Literal, among: Sequence[str]) -> str:
    """One of the names `among`; quotes and `Enumeration::name` are accepted."""
    if isinstance(literal, (Name, Text)):
        word = literal.text if isinstance(literal, Name) else literal.value
        word = word.rpartition("::")[2]
        if word in among:
            return word
        raise OutOfRange(
            f"`{word}` is not one of {join_names(among)}", label=did_you_mean(word, among)
        )
    raise TypeMismatch(f"{_describe(literal)}, not one of {join_names(among)}")


def as_type(literal: Literal, type_: types.Type) -> types.Literal:
    """The default value of a field of this type."""
    match type_:
        case types.BOOL:
            return as_bool(literal)
        case types.FLOAT | types.DOUBLE:
            return as_float(literal)
        case types.Primitive() if type_.is_text:
            return _as_bounded_string(literal, type_.bound)
        case types.Primitive():
            return as_int(literal, type_.bits, unsigned=type_.is_unsigned)
        case types.Enum():
            return as_choice(literal, [enumerator.name for enumerator in type_.enumerators])
    raise TypeMismatch(f"a `{type_.name}` cannot have a default; it starts empty")


def join_names(names: Sequence[str], most: int = 8) -> str:
    """Names for a message: the first `most` names and the number of the others."""
    shown = ", ".join(f"`{name}`" for name in names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown


def _describe(literal: Literal) -> str:
    match literal:
        case Text():
            return f"`{literal.span.text}` is a string"
        case Bool():
            return f"`{literal.span.text}` is a bool"
        case Number():
            return f"`{literal.span.text}` is a number"
    return f"`{literal.span.text}` is a name"
