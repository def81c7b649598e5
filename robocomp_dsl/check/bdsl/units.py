"""Units in a bridge: validity, and conversion of a value to another unit.

In: units as written and typed expressions. Out: converted expressions, and findings.
"""

from __future__ import annotations

from functools import lru_cache

from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.check.idsl.units import WRITTEN_OUT
from robocomp_dsl.diagnostics import Edit, Fix, Report, nearest
from robocomp_dsl.model import units
from robocomp_dsl.model.bridge_ports import TIME, ItemGroup, ItemsType, ValueType
from robocomp_dsl.model.bridge_values import (
    Arithmetic,
    ConstantValue,
    Converted,
    Expression,
    ItemAt,
    TimeIn,
)
from robocomp_dsl.model.types import (
    DOUBLE,
    LONG,
    NUMBERS,
    Dictionary,
    Primitive,
    Sequence,
    Struct,
    Type,
)
from robocomp_dsl.syntax.ast.base import Unit

_NANOSECOND = units.parse_unit("ns")
_MOST_UNITS = 1000
"""Units whose conversion is cached; an editor checks many that are being typed."""


def has_numbers(type_: ValueType) -> bool:
    """Whether values of the type are numbers, or contain numbers."""
    match type_:
        case Primitive():
            return type_ in NUMBERS
        case Sequence():
            return has_numbers(type_.element)
        case Dictionary():
            return has_numbers(type_.value)
        case Struct():
            return any(has_numbers(field.type) for field in type_.fields)
        case ItemsType():
            return any(has_numbers(group.type) for group in type_.groups)
    return False


def declared_unit(unit: Unit | None, type_: Type, report: Report) -> str:
    """The unit that is declared for a value; an invalid one is reported, and empty."""
    if unit is None:
        return ""
    if not has_numbers(type_):
        report.add(
            codes.INVALID_UNIT,
            unit.span,
            f"`{type_.name}` is not a number and has no unit",
            fix=Fix("remove the unit", (Edit(unit.span, ""),)),
        )
        return ""
    return valid_unit(unit, report)


def valid_unit(unit: Unit, report: Report) -> str:
    """The text of a unit; an invalid one is reported, and empty."""
    text = unit.text.strip()
    if not text:
        return ""  # the parser reported it
    try:
        units.parse_unit(text)
    except units.InvalidUnit as error:
        report.add(codes.INVALID_UNIT, unit.span, f"invalid unit: {error}")
        return ""
    for word in _unknown_words(text):
        symbol = WRITTEN_OUT.get(word.lower())
        guess = symbol or nearest(word, units.known_units())
        is_case = guess is not None and (symbol or guess.lower() == word.lower())
        fixed = f"[{text.replace(word, guess)}]" if guess and is_case else ""
        report.add(
            codes.UNKNOWN_UNIT,
            unit.span,
            f"unknown unit `{word}`: it is converted to itself only",
            label=f"did you mean `{guess}`?" if guess else "",
            help="" if guess else "this is correct if the program counts in units of its own",
            fix=Fix(f"change to `{fixed}`", (Edit(unit.span, fixed),)) if fixed else None,
        )
    return text


@lru_cache(maxsize=_MOST_UNITS)
def parsed(text: str) -> units.MeasureUnit | None:
    """The unit of an imported or checked text; None if it is not valid."""
    try:
        return units.parse_unit(text)
    except units.InvalidUnit:
        return None


@lru_cache(maxsize=_MOST_UNITS)
def _unknown_words(text: str) -> tuple[str, ...]:
    """The words of a valid unit that have no conversion."""
    return tuple(units.unknown_words(text))


@lru_cache(maxsize=_MOST_UNITS)
def _conversion(source: str, target: str, *, ignore_angle: bool) -> tuple[float, float] | None:
    """Factor and offset between two units that are valid; None if their dimensions differ."""
    first, second = units.parse_unit(source), units.parse_unit(target)
    if ignore_angle:
        first, second = first.without_angle(), second.without_angle()
    return units.conversion(first, second)


def with_unit(type_: ValueType, unit: str) -> ValueType:
    """The type of a list whose items get another unit; other types as they are."""
    if not isinstance(type_, ItemsType):
        return type_
    groups = tuple(
        ItemGroup(DOUBLE if g.type in NUMBERS else g.type, unit, g.count) for g in type_.groups
    )
    return ItemsType(groups)


def convert(value: Expression, unit: str, what: str, context: BridgeContext) -> Expression:
    """`value` in `unit`. Raises `FaultyExpression` if the units have no common dimension.

    `what` names the target in messages. A value without unit is left as it is, and one with a unit
    for a target without one gives a warning.
    """
    if not has_numbers(value.type) or value.unit == unit:
        return value
    if not unit:
        _report_dropped(value, what, context)
        return value
    if not value.unit:
        return _mixed(value, unit, what, context)
    if parsed(value.unit) is None or parsed(unit) is None:
        return value
    is_product = isinstance(value, Arithmetic) and value.operator in "*/"
    factors = _conversion(value.unit, unit, ignore_angle=is_product)
    if factors is None:
        message = f"`{value.unit}` cannot be converted to `{unit}`, the unit of {what}"
        context.fail(codes.UNIT_MISMATCH, value.span, message)
    return _scaled(value, factors, unit)


def convert_to(value: Expression, unit: Unit, context: BridgeContext) -> Expression:
    """`value to [unit]`. Raises `FaultyExpression`."""
    text = valid_unit(unit, context.report)
    if not text:
        raise FaultyExpression
    if value.type == TIME:
        return _time_in(value, text, unit, context)
    if not has_numbers(value.type) or isinstance(value.type, (Struct, Dictionary)):
        message = f"`{value.span.text}` is {a_type(value.type)}, and `to` converts numbers"
        context.fail(codes.VALUE_TYPE, value.span, message)
    if not value.unit and _units_of(value) == {""}:
        if isinstance(value, ConstantValue):
            return value.replace(unit=text)
        message = f"`{value.span.text}` has no unit that could be converted to `{text}`"
        help_ = (
            "declare the unit where the value comes from, such as `input angle : double [deg]`,"
            f" or remove `to {unit.span.text}`"
        )
        context.fail(codes.MISSING_UNIT, value.span, message, help_)
    return convert(value, text, f"`to [{text}]`", context)


def _scaled(value: Expression, factors: tuple[float, float], unit: str) -> Expression:
    factor, offset = factors
    if factor == 1 and offset == 0:
        type_ = value.type
        if isinstance(type_, ItemsType):
            type_ = ItemsType(tuple(g.replace(unit=unit) for g in type_.groups))
        return value.replace(unit=unit, type=type_)
    if isinstance(value, ConstantValue):
        return value.replace(type=DOUBLE, unit=unit, value=float(value.value) * factor + offset)
    type_ = DOUBLE if isinstance(value.type, Primitive) else with_unit(value.type, unit)
    if isinstance(type_, Sequence):
        type_ = ItemsType((ItemGroup(DOUBLE, unit, value.length),))
    return Converted(value.span, type_, unit, value.length, value, factor, offset)


def _units_of(value: Expression) -> set[str]:
    if isinstance(value.type, ItemsType):
        return {group.unit for group in value.type.groups}
    return {value.unit}


def _mixed(value: Expression, unit: str, what: str, context: BridgeContext) -> Expression:
    """A value without a unit: fine, unless it is a list whose items have several units."""
    several = sorted(text for text in _units_of(value) if text)
    if several:
        message = f"the items have several units ({', '.join(several)}), {what} has `{unit}`"
        help_ = "select the items of one unit: `hub[0:2]`"
        context.fail(codes.UNIT_MISMATCH, value.span, message, help_)
    return value


def _report_dropped(value: Expression, what: str, context: BridgeContext) -> None:
    if context.states_unit(value) or not value.unit or isinstance(value.type, Struct):
        return
    parsed_unit = parsed(value.unit)
    if parsed_unit is not None and not parsed_unit.dimension:
        return
    text = f" to [{value.unit}]"
    end = value.span.subspan(value.span.end, value.span.end)
    advice = f"`{value.span.text}{text}`"
    fix: Fix | None = Fix(f"append `{text.strip()}`", (Edit(end, text),))
    if isinstance(value, ItemAt) and value.span == value.value.span:  # the list is written
        advice, fix = f"`{{ …, {value.span.text}[{value.index}]{text}, … }}`", None
    context.report.add(
        codes.UNIT_DROPPED,
        value.span,
        f"{what} has no unit; the value is in {value.unit}",
        help=f"state the unit in which it is sent: {advice}",
        fix=fix,
    )


def nanoseconds_of(unit: str) -> int:
    """The length of a unit of time in nanoseconds; 0 if it is none, or a fraction."""
    parsed_unit = parsed(unit)
    factors = units.conversion(parsed_unit, _NANOSECOND) if parsed_unit else None
    if factors is None or not factors[0].is_integer():
        return 0
    return int(factors[0])


def _time_in(value: Expression, text: str, unit: Unit, context: BridgeContext) -> Expression:
    nanoseconds = nanoseconds_of(text)
    if not nanoseconds:
        message = f"`{value.span.text}` is a time, and `{text}` is no unit of time"
        help_ = "write `to [s]`, `to [ms]`, `to [us]` or `to [ns]`"
        context.fail(codes.UNIT_MISMATCH, unit.span, message, help_)
    type_ = LONG if nanoseconds < 10**9 else DOUBLE
    return TimeIn(value.span, type_, text, None, value, nanoseconds)
