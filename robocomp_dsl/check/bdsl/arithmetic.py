"""Types arithmetic: numbers, lists of numbers, and differences of instants."""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.items import groups_of
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.bdsl.units import convert, parsed
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.model.bridge_ports import TIME, ItemGroup, ItemsType, common_number
from robocomp_dsl.model.bridge_values import Arithmetic, ConstantValue, Expression, Negated
from robocomp_dsl.model.types import DOUBLE, NUMBERS, Primitive
from robocomp_dsl.syntax.ast import bdsl as ast


def arithmetic(
    node: ast.Operation, left: Expression, right: Expression, context: BridgeContext
) -> Expression:
    """`left operator right`. Raises `FaultyExpression`."""
    operator = node.operator
    if TIME in (left.type, right.type):
        return _difference(node, left, right, context)
    types = [_number_type(value, operator, context) for value in (left, right)]
    _check_lengths(node, left, right, context)
    if operator in "+-":
        unit = left.unit or right.unit
        if left.unit and right.unit:
            right = convert(right, left.unit, f"`{left.span.text}`", context)
    else:
        unit = _product_unit(node, left, right, context)
    if operator == "/" and isinstance(right, ConstantValue) and right.value == 0:
        context.fail(codes.INVALID_ARITHMETIC, node.span, "division by zero")
    number = DOUBLE if operator == "/" else common_number(types)
    if not left.is_list and not right.is_list:
        return Arithmetic(node.span, number, unit, None, operator, left, right)
    length = left.length if right.length is None else right.length
    type_ = ItemsType((ItemGroup(number, unit, length),))
    return Arithmetic(node.span, type_, unit, length, operator, left, right)


def negated(node: ast.Negation, value: Expression, context: BridgeContext) -> Expression:
    """`-value`. Raises `FaultyExpression`."""
    _number_type(value, "-", context)
    if isinstance(value, ConstantValue) and not isinstance(value.value, str):
        negative = value.replace(span=node.span, value=-value.value)
        if context.states_unit(value):
            context.state_unit(negative)
        return negative
    return Negated(node.span, value.type, value.unit, value.length, value)


def _difference(
    node: ast.Operation, left: Expression, right: Expression, context: BridgeContext
) -> Expression:
    if left.type != TIME or right.type != TIME or node.operator != "-":
        context.fail(
            codes.INVALID_ARITHMETIC,
            node.span,
            "of two times only the difference can be computed",
            "write such as `now - stamp(input)`, or calculate with `now to [s]`",
        )
    return Arithmetic(node.span, DOUBLE, "s", None, "-", left, right)


def _number_type(value: Expression, operator: str, context: BridgeContext) -> Primitive:
    types = [group.type for group in groups_of(value)]
    numbers = [type_ for type_ in types if isinstance(type_, Primitive) and type_ in NUMBERS]
    if not numbers or len(numbers) != len(types):
        found = next((type_ for type_ in types if type_ not in NUMBERS), value.type)
        message = f"`{operator}` calculates with numbers; this is {a_type(found)}"
        is_text = isinstance(found, Primitive) and found.is_text
        help_ = f"`number({value.span.text})` converts" if is_text else ""
        if isinstance(value, ConstantValue) and is_text:
            help_ = "texts cannot be joined; declare a function: `function joined(…) -> string;`"
        context.fail(codes.INVALID_ARITHMETIC, value.span, message, help_)
    return common_number(numbers)


def _check_lengths(
    node: ast.Operation, left: Expression, right: Expression, context: BridgeContext
) -> None:
    lengths = (left.length, right.length)
    both = left.is_list and right.is_list and None not in lengths
    if both and lengths[0] != lengths[1]:
        message = f"lists of {lengths[0]} and {lengths[1]} items cannot be combined item by item"
        context.fail(codes.VALUE_LENGTH, node.span, message)


def _product_unit(
    node: ast.Operation, left: Expression, right: Expression, context: BridgeContext
) -> str:
    for value in (left, right):
        unit = parsed(value.unit) if value.unit else None
        if unit is not None and unit.offset:
            message = f"a temperature in {value.unit} cannot be multiplied or divided"
            help_ = f"convert it: `({value.span.text} to [K])`"
            context.fail(codes.INVALID_ARITHMETIC, node.span, message, help_)
    if not right.unit:
        return left.unit
    if node.operator == "*":
        return f"{left.unit} {right.unit}" if left.unit else right.unit
    divisor = right.unit if right.unit.isalpha() else f"({right.unit})"
    return f"{left.unit or '1'}/{divisor}"
