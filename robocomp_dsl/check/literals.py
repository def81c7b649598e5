"""Written values as values of a kind: defaults of fields and parameters, settings of a deployment.

In: a literal of a tree. Out: the plain value, or `Misfit` with what is wrong in words.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.model import types
from robocomp_dsl.syntax.ast_base import Bool, Literal, Name, Number, Text


class Misfit(Exception):
    """The value is of another kind. `label` goes beside the carets, `replacement` mends it."""

    def __init__(self, message: str, label: str = "", replacement: str | None = None) -> None:
        super().__init__(message)
        self.label = label
        self.replacement = replacement


class OutOfRange(Misfit):
    """The kind is right, the value is not."""


def as_bool(literal: Literal) -> bool:
    """`true` or `false`."""
    if isinstance(literal, Bool):
        return literal.value
    if isinstance(literal, Name) and literal.text.lower() in ("true", "false"):
        return literal.text.lower() == "true"
    raise Misfit(f"{_described(literal)}, but a `bool` is `true` or `false`")


def as_int(literal: Literal, bits: int = 64) -> int:
    """A whole number that fits into a signed integer of `bits` bits; a byte is 0 to 255."""
    if not isinstance(literal, Number):
        raise Misfit(f"{_described(literal)}, not a whole number")
    if isinstance(literal.value, float) and not literal.value.is_integer():
        raise Misfit(f"`{literal.span.text}` has a fraction, an integer has none")
    low, high = (0, 255) if bits == 8 else (-(1 << (bits - 1)), (1 << (bits - 1)) - 1)
    if not low <= literal.value <= high:
        raise OutOfRange(f"`{literal.span.text}` is outside {low} to {high}")
    return int(literal.value)


def as_float(literal: Literal) -> float:
    """A finite number."""
    if not isinstance(literal, Number):
        raise Misfit(f"{_described(literal)}, not a number")
    try:
        value = float(literal.value)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value):
        raise OutOfRange(f"`{literal.span.text}` is too large for a number with a fraction")
    return value


def as_string(literal: Literal) -> str:
    """A quoted text."""
    if isinstance(literal, Text):
        return literal.value
    written = literal.span.text
    raise Misfit(f"{_described(literal)}, not a text in quotes", replacement=f'"{written}"')


def as_choice(literal: Literal, among: Sequence[str]) -> str:
    """One of some names; also accepted in quotes, or as `Enumeration::name`."""
    if isinstance(literal, (Name, Text)):
        word = literal.text if isinstance(literal, Name) else literal.value
        word = word.rpartition("::")[2]
        if word in among:
            return word
        raise OutOfRange(
            f"`{word}` is not one of {listing(among)}", label=did_you_mean(word, among)
        )
    raise Misfit(f"{_described(literal)}, not one of {listing(among)}")


def as_type(literal: Literal, type_: types.Type) -> types.Literal:
    """The default of a field of this type."""
    match type_:
        case types.BOOL:
            return as_bool(literal)
        case types.FLOAT | types.DOUBLE:
            return as_float(literal)
        case types.STRING:
            return as_string(literal)
        case types.Primitive():
            return as_int(literal, type_.bits)
        case types.Enum():
            return as_choice(literal, [one.name for one in type_.enumerators])
    raise Misfit(f"a `{type_.name}` begins empty and cannot be given a default")


def listing(names: Sequence[str], most: int = 8) -> str:
    """Names for a message: the first ones, and how many more there are."""
    shown = ", ".join(f"`{name}`" for name in names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown


def _described(literal: Literal) -> str:
    match literal:
        case Text():
            return f"`{literal.span.text}` is a text"
        case Bool():
            return f"`{literal.span.text}` is a bool"
        case Number():
            return f"`{literal.span.text}` is a number"
    return f"`{literal.span.text}` is a name"
