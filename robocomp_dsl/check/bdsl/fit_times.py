"""Fits instants and durations to types: ROS `Time` and `Duration`, numbers with a unit of time."""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.fit_numbers import reject
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.bdsl.units import convert, nanoseconds_of
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.model.bridge_ports import TIME, ValueType
from robocomp_dsl.model.bridge_values import Cast, Expression, TimeIn
from robocomp_dsl.model.types import DOUBLE, NUMBERS, Primitive, Struct

_TIMES = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")
_WIDE = 64
_SECOND = 10**9


def is_ros_time(type_: ValueType) -> bool:
    """Whether it is the ROS struct for an instant or a duration."""
    return isinstance(type_, Struct) and type_.ros_name in _TIMES


def fit_time(value: Expression, target: ValueTarget, context: BridgeContext) -> Expression:
    """An instant for any target, or a number of seconds for a ROS struct."""
    if value.type != TIME:
        return _duration(value, target, context)
    if is_ros_time(target.type):
        if target.type.name == "Time":
            return Cast(value.span, target.type, "", None, value)
        help_ = "the duration between two instants is such as `now - stamp(input)`"
        reject(value, target, context, help_)
    if not isinstance(target.type, Primitive) or target.type not in NUMBERS:
        reject(value, target, context, _forms(value))
    if not target.unit:
        message = f"{target.name} has no unit, so it is unknown how it counts time"
        context.fail(codes.TIME_TYPE, value.span, message, _forms(value))
    return _number(value, target, target.type, context)


def _number(
    value: Expression, target: ValueTarget, type_: Primitive, context: BridgeContext
) -> Expression:
    nanoseconds = nanoseconds_of(target.unit)
    if not nanoseconds:
        reject(value, target, context, f"`{target.unit}` is no unit of time")
    seconds_in_unsigned = nanoseconds >= _SECOND and type_.bits >= 32 and type_.is_unsigned
    if type_.bits < _WIDE and not seconds_in_unsigned:
        message = f"{target.name} is {a_type(type_)}, which cannot hold a time in {target.unit}"
        context.fail(
            codes.TIME_TYPE, value.span, message, "use a `double [s]` or a `long [ns]` there"
        )
    return TimeIn(value.span, type_, target.unit, None, value, nanoseconds)


def _duration(value: Expression, target: ValueTarget, context: BridgeContext) -> Expression:
    """A number with a unit of time as a ROS struct."""
    if value.type not in NUMBERS or not nanoseconds_of(value.unit):
        reject(value, target, context, "`now`, or a number such as `0.5 [s]`, fits")
    seconds = convert(value, "s", target.name, context)
    if seconds.type != DOUBLE:
        seconds = Cast(value.span, DOUBLE, "s", None, seconds)
    return Cast(value.span, target.type, "", None, seconds)


def _forms(value: Expression) -> str:
    text = value.span.text
    return f"write `{text} to [s]` for seconds, or `{text} to [ns]` for nanoseconds"
