"""Fits a scalar to a built-in type or an enumeration.

Numbers fit wider numbers; integers fit floating-point types; `double` fits `float`.
"""

from __future__ import annotations

from typing import NoReturn

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.items import same_type
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Edit, Fix
from robocomp_dsl.model.bridge_ports import ValueType
from robocomp_dsl.model.bridge_values import (
    Arithmetic,
    Cast,
    ConstantValue,
    Converted,
    Counter,
    Expression,
    ItemAt,
    Negated,
    NumberOf,
)
from robocomp_dsl.model.types import DOUBLE, FLOAT, NUMBERS, Enum, Primitive

FRACTIONS = (FLOAT, DOUBLE)


def fit_scalar(value: Expression, target: ValueTarget, context: BridgeContext) -> Expression:
    """`value`, which is no list, struct or time, as a value of the target."""
    if isinstance(target.type, Enum) or not isinstance(target.type, Primitive):
        if not same_type(value.type, target.type):
            reject(value, target, context, _enum_help(target))
        return value
    if isinstance(value, ConstantValue):
        return _fit_constant(value, target, target.type, context)
    if value.type == target.type:
        return _checked(value)
    if not number_fits(value.type, target.type) and not _is_exact(value, target.type):
        reject(value, target, context, *_advice(value, target.type))
    return Cast(value.span, target.type, value.unit, None, value)


def number_fits(source: ValueType, target: ValueType) -> bool:
    """Whether every value of type `source` is one of type `target`, a built-in type."""
    if not isinstance(source, Primitive) or not isinstance(target, Primitive):
        return same_type(source, target)
    if source not in NUMBERS or target not in NUMBERS:
        return source == target or (source.is_text and target.is_text and not target.bound)
    if target in FRACTIONS or source in FRACTIONS:
        return target in FRACTIONS
    if source.is_unsigned == target.is_unsigned:
        return source.bits <= target.bits
    return source.is_unsigned and source.bits < target.bits


def _is_text(type_: ValueType) -> bool:
    return isinstance(type_, Primitive) and type_.is_text


def is_rounded(value: Expression) -> bool:
    """Whether the user asked for rounding: `number(x)`, also converted to another unit."""
    if isinstance(value, (Converted, Negated)):
        return is_rounded(value.value)
    return isinstance(value, NumberOf)


def _is_exact(value: Expression, target: Primitive) -> bool:
    """Whether a check at run time suffices: `number(x)`, `counter`, sums of integers."""
    if target not in NUMBERS or value.type not in NUMBERS:
        return _is_text(value.type) and target.is_text
    if is_rounded(value) or isinstance(value, Counter):
        return True
    if isinstance(value, Converted) and value.factor.is_integer() and not value.offset:
        return value.value.type not in FRACTIONS
    return isinstance(value, Arithmetic) and value.type not in FRACTIONS


def _checked(value: Expression) -> Expression:
    """An integer result of arithmetic gets a check of its range at run time."""
    if isinstance(value, Arithmetic) and value.type in NUMBERS and value.type not in FRACTIONS:
        return Cast(value.span, value.type, value.unit, None, value)
    return value


def _fit_constant(
    value: ConstantValue, target: ValueTarget, type_: Primitive, context: BridgeContext
) -> Expression:
    written = value.value
    if isinstance(written, str):
        if not type_.is_text:
            reject(value, target, context, *_advice(value, type_))
        if type_.bound and len(written.encode()) > type_.bound:
            message = f"{target.name}: `{value.span.text}` is longer than {type_.bound} bytes"
            context.fail(codes.VALUE_LENGTH, value.span, message)
        return value.replace(type=type_)
    if isinstance(written, bool) or type_ not in NUMBERS:
        if value.type != type_:
            reject(value, target, context, *_advice(value, type_))
        return value
    if type_ in FRACTIONS:
        return value.replace(type=type_, value=float(written))
    if isinstance(written, float) and not written.is_integer():
        reject(value, target, context, *_advice(value, type_))
    low = 0 if type_.is_unsigned else -(1 << (type_.bits - 1))
    high = (1 << (type_.bits - (0 if type_.is_unsigned else 1))) - 1
    if not low <= written <= high:
        message = f"{target.name} is {a_type(type_)}: {value.span.text} is outside {low} to {high}"
        context.fail(codes.VALUE_TYPE, value.span, message)
    return value.replace(type=type_, value=int(written))


def reject(
    value: Expression,
    target: ValueTarget,
    context: BridgeContext,
    help_: str = "",
    fix: Fix | None = None,
) -> NoReturn:
    """Report a value whose type does not fit. Raises `FaultyExpression`."""
    message = f"{target.name} is {a_type(target.type)}, not {a_type(value.type)}"
    context.fail(codes.VALUE_TYPE, value.span, message, help_, fix)


def _advice(value: Expression, target: Primitive) -> tuple[str, Fix | None]:
    """How to convert `value`, and the edit."""
    function, reason = "", "converts"
    if target.is_text and isinstance(value.type, Primitive):
        function = "text"
    elif target in NUMBERS and isinstance(value.type, (Primitive, Enum)):
        function = "number"
        if value.type in NUMBERS:
            reason = "rounds, and drops a message whose value is out of range"
    if not function:
        return "", None
    if isinstance(value, ConstantValue):
        return _literal_advice(value, target)
    if isinstance(value, ItemAt) and value.span == value.value.span:  # the list is written
        return f"write the items: `{{ …, {function}({value.span.text}[{value.index}]), … }}`", None
    text = f"{function}({value.span.text})"
    if isinstance(value, Converted) and value.value.type not in FRACTIONS:
        reason += f"; {value.value.unit} in {value.unit} has a fraction"
    return f"`{text}` {reason}", Fix(f"change to `{text}`", (Edit(value.span, text),))


def _literal_advice(value: ConstantValue, target: Primitive) -> tuple[str, Fix | None]:
    text = value.span.text
    if target.is_text:
        quoted = f'"{text}"'
        return f"write {quoted}", Fix(f"change to `{quoted}`", (Edit(value.span, quoted),))
    if isinstance(value.value, str):
        return "write a number without quotes", None
    return "write a whole number" if isinstance(value.value, float) else "write a number", None


def _enum_help(target: ValueTarget) -> str:
    if not isinstance(target.type, Enum):
        return ""
    names = [enumerator.name for enumerator in target.type.enumerators]
    return f"it is one of {join_names(names)}"
