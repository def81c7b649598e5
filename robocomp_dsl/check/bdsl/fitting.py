"""Fits a value to the type and unit of its target; each implicit conversion becomes a node.

In: a typed expression and the type and unit of a field, parameter or message. Out: an expression of
exactly this type, or None and a finding.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NoReturn

from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.fit_numbers import (
    fit_scalar,
    is_rounded,
    number_fits,
    reject,
)
from robocomp_dsl.check.bdsl.fit_times import fit_time, is_ros_time
from robocomp_dsl.check.bdsl.items import groups_of, item_at, items_of, same_type
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type, type_text
from robocomp_dsl.check.bdsl.units import convert
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.diagnostics import Edit, Fix
from robocomp_dsl.model.bridge_ports import TIME, ValueType
from robocomp_dsl.model.bridge_values import (
    Cast,
    Expression,
    LengthChecked,
    ListExpression,
    StructOf,
)
from robocomp_dsl.model.types import NUMBERS, Dictionary, Primitive, Sequence, Struct


def fit(value: Expression, target: ValueTarget, context: BridgeContext) -> Expression:
    """`value` with the type and unit of `target`."""
    if isinstance(value.type, Struct) and value.type is target.type:
        return value
    if (value.type == TIME or is_ros_time(target.type)) and not value.is_list:
        return fit_time(value, target, context)
    match target.type:
        case Struct() as struct:
            return _fit_struct(value, target, struct, context)
        case Sequence() as sequence:
            return _fit_sequence(value, target, sequence, context)
        case Dictionary():
            if not same_type(value.type, target.type):
                reject(value, target, context)
            return value
    return _fit_scalar(value, target, context)


def _fit_scalar(value: Expression, target: ValueTarget, context: BridgeContext) -> Expression:
    if value.is_list:
        item = item_at(value, 0) if value.length == 1 else None
        if item is None:
            _reject_list(value, target, context)
        return fit(item, target, context)
    if isinstance(value.type, Struct):
        reject(value, target, context, *_field_advice(value, value.type, target))
    if target.type in NUMBERS and value.type in NUMBERS:
        value = convert(value, target.unit, target.name, context)
    return fit_scalar(value, target, context)


def _reject_list(value: Expression, target: ValueTarget, context: BridgeContext) -> NoReturn:
    count = "a list" if value.length is None else f"a list of {value.length} items"
    text = value.span.text
    is_simple = _is_simple(value)
    end = value.span.subspan(value.span.end, value.span.end)
    context.fail(
        codes.VALUE_TYPE,
        value.span,
        f"{target.name} is {a_type(target.type)}, not {count}",
        f"select an item: `{text}[0]`" if is_simple else f"select an item: `({text})[0]`",
        Fix("append `[0]`", (Edit(end, "[0]"),)) if is_simple else None,
    )


def _is_simple(value: Expression) -> bool:
    """Whether it is a name, possibly with fields, so that more can be appended."""
    return value.span.text.replace("_", "").replace(".", "").isalnum()


def _field_advice(value: Expression, struct: Struct, target: ValueTarget) -> tuple[str, Fix | None]:
    """Which field of a struct to select for a scalar."""
    fitting = [field.name for field in struct.fields if number_fits(field.type, target.type)]
    if not fitting:
        return f"its fields are {join_names([field.name for field in struct.fields])}", None
    end = value.span.subspan(value.span.end, value.span.end)
    suffix = f".{fitting[0]}"
    only = len(fitting) == 1
    help_ = "select a field: " + join_names([f"{value.span.text}.{name}" for name in fitting])
    return help_, Fix(f"append `{suffix}`", (Edit(end, suffix),)) if only else None


def _fit_struct(
    value: Expression, target: ValueTarget, struct: Struct, context: BridgeContext
) -> Expression:
    if isinstance(value.type, Struct):
        reject(value, target, context, _same_fields(value, value.type, struct))
    names = [field.name for field in struct.fields]
    if not value.is_list:
        reject(value, target, context, f"its fields are {join_names(names)}")
    if value.unit and not target.unit and not any(field.unit for field in struct.fields):
        convert(value, "", target.name, context)  # one warning for all fields
        context.state_unit(value)
    count = len(names)
    checked = value
    if value.length is None:
        checked = LengthChecked(value.span, value.type, value.unit, count, value, count, count)
    elif value.length != count:
        message = (
            f"{target.name}, a `{struct.name}`, has {count} fields; this has {value.length} items"
        )
        context.fail(codes.VALUE_LENGTH, value.span, message, f"the fields are {join_names(names)}")
    items = items_of(checked)
    if items is None:
        help_ = "declare the lengths of the inputs, as in `double[2]`"
        reject(value, target, context, help_)
    targets = [target.field(field) for field in struct.fields]
    return StructOf(value.span, struct, target.unit, None, fit_all(items, targets, context))


def fit_all(
    values: Iterable[Expression], targets: Iterable[ValueTarget], context: BridgeContext
) -> tuple[Expression, ...]:
    """Each value for its target. Raises `FaultyExpression` after all of them were checked."""
    fitted: list[Expression] = []
    faulty = False
    for value, target in zip(values, targets, strict=True):
        try:
            fitted.append(fit(value, target, context))
        except FaultyExpression:
            faulty = True
    if faulty:
        raise FaultyExpression
    return tuple(fitted)


def _same_fields(value: Expression, source: Struct, target: Struct) -> str:
    """The list of fields that converts a struct to another one with the same field names."""
    names = [field.name for field in source.fields]
    if [field.name for field in target.fields] != names or not _is_simple(value):
        return ""
    text = ", ".join(f"{value.span.text}.{name}" for name in names)
    return f"write its fields: `{{ {text} }}`"


def _fit_sequence(
    value: Expression, target: ValueTarget, sequence: Sequence, context: BridgeContext
) -> Expression:
    if not value.is_list:
        _reject_scalar(value, target, sequence, context)
    _check_length(value, target, sequence, context)
    if isinstance(value, ListExpression):
        return _fit_items(value, target, sequence, context)
    converted = convert(value, target.unit, target.name, context)
    checked = _length_checked(converted, sequence)
    if isinstance(checked.type, Sequence) and same_type(checked.type, sequence):
        return checked
    for group in groups_of(checked):
        is_number = group.type in NUMBERS and sequence.element in NUMBERS
        if number_fits(group.type, sequence.element) or (is_number and is_rounded(checked)):
            continue
        _reject_items(value, group.type, target, sequence, context)
    return Cast(value.span, sequence, target.unit, checked.length, checked)


def _fit_items(
    value: ListExpression, target: ValueTarget, sequence: Sequence, context: BridgeContext
) -> Expression:
    """`{ a, b }`: each item by itself."""
    parts = fit_all(value.items, [target.item(sequence)] * len(value.items), context)
    return ListExpression(value.span, sequence, target.unit, len(parts), parts)


def _check_length(
    value: Expression, target: ValueTarget, sequence: Sequence, context: BridgeContext
) -> None:
    size, bound = sequence.size, sequence.bound
    length = value.length
    if length is None or (length == (size or length) and length <= (bound or length)):
        return
    needed = f"{size} items" if size else f"at most {bound} items"
    is_longer = length > (size or bound) and not isinstance(value, ListExpression)
    context.fail(
        codes.VALUE_LENGTH,
        value.span,
        f"{target.name} has {needed}; this has {length}",
        f"select some: `{value.span.text}[0:{size or bound}]`" if is_longer else "",
    )


def _length_checked(value: Expression, sequence: Sequence) -> Expression:
    """`value` with a check at run time, if its length is known only then and is limited."""
    if value.length is not None or not (sequence.size or sequence.bound):
        return value
    least, most = sequence.size, sequence.size or sequence.bound
    length = sequence.size or None
    return LengthChecked(value.span, value.type, value.unit, length, value, least, most)


def _reject_scalar(
    value: Expression, target: ValueTarget, sequence: Sequence, context: BridgeContext
) -> NoReturn:
    text = f"{{ {value.span.text} }}"
    if isinstance(value.type, Primitive) and isinstance(sequence.element, Primitive):
        fix = Fix(f"change to `{text}`", (Edit(value.span, text),))
        reject(value, target, context, f"a list with one item is `{text}`", fix)
    reject(value, target, context)


def _reject_items(
    value: Expression,
    item: ValueType,
    target: ValueTarget,
    sequence: Sequence,
    context: BridgeContext,
) -> NoReturn:
    help_, fix = "", None
    if sequence.element in NUMBERS and item in NUMBERS:
        text = f"number({value.span.text})"
        help_ = f"`{text}` rounds, and drops a message whose value is out of range"
        fix = Fix(f"change to `{text}`", (Edit(value.span, text),))
    elements, found = type_text(sequence.element), type_text(item)
    message = f"{target.name} is a list of `{elements}`, this contains `{found}`"
    context.fail(codes.VALUE_TYPE, value.span, message, help_, fix)
