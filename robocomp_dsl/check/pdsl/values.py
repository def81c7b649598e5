"""Values of parameters: defaults and settings of deployments.

In: a literal and a kind or a parameter. Out: the value; raises `TypeMismatch`.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.literals import (
    OutOfRange,
    as_bool,
    as_choice,
    as_float,
    as_int,
    as_string,
)
from robocomp_dsl.model import types
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.syntax.ast.base import Literal


def as_kind(literal: Literal, kind: Kind, choices: Sequence[str] = ()) -> types.Literal:
    """The value of a parameter of this kind, which is not `GROUP`."""
    match kind:
        case Kind.BOOL:
            return as_bool(literal)
        case Kind.INT:
            return as_int(literal)
        case Kind.FLOAT:
            return as_float(literal)
        case Kind.CHOICE:
            return as_choice(literal, choices)
    return as_string(literal)


def check_range(value: types.Literal, parameter: Parameter) -> None:
    """Raise `OutOfRange` if a number exceeds the bounds of its parameter."""
    if parameter.kind not in (Kind.INT, Kind.FLOAT) or isinstance(value, str):
        return
    below = parameter.low is not None and value < parameter.low
    above = parameter.high is not None and value > parameter.high
    if below or above:
        raise OutOfRange(f"{format_number(value)} is not {describe_bounds(parameter)}")


def describe_bounds(parameter: Parameter) -> str:
    """`within 1 to 1000`, `at least 1` or `at most 1000`, with the unit."""
    unit = f" {parameter.unit}" if parameter.unit else ""
    low = None if parameter.low is None else format_number(parameter.low)
    high = None if parameter.high is None else format_number(parameter.high)
    if high is None:
        return f"at least {low}{unit}"
    return f"at most {high}{unit}" if low is None else f"within {low} to {high}{unit}"


def format_number(number: float) -> str:
    """A number without a redundant `.0` or exponent."""
    whole = isinstance(number, int) or (number.is_integer() and abs(number) < 1e15)
    return str(int(number)) if whole else repr(number)
