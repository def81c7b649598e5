"""Types calls of functions: `number`, `text`, `length`, and those of the user."""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.fitting import fit_all
from robocomp_dsl.check.bdsl.items import groups_of, length_of
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.model.bridge_ports import TIME, BridgeFunction, ItemGroup, ItemsType, ValueType
from robocomp_dsl.model.bridge_values import Called, Expression, LengthOf, NumberOf, TextOf
from robocomp_dsl.model.types import DOUBLE, INT, NUMBERS, STRING, Enum, Primitive
from robocomp_dsl.syntax.ast import bdsl as ast


def built_in(node: ast.FunctionCall, value: Expression, context: BridgeContext) -> Expression:
    """`number(x)`, `text(x)` or `length(x)`. Raises `FaultyExpression`."""
    match node.name.text:
        case "number":
            return _number(node, value, context)
        case "text":
            if not isinstance(value.type, (Primitive, Enum)) and value.type != TIME:
                _reject(node, value, "a string, number, bool or time", context)
            return TextOf(node.span, STRING, "", None, value)
    is_text = isinstance(value.type, Primitive) and value.type.is_text
    if not value.is_list and not is_text:
        _reject(node, value, "a list or string", context)
    return LengthOf(node.span, INT, "", None, value)


def user_call(
    node: ast.FunctionCall,
    function: BridgeFunction,
    arguments: tuple[Expression, ...],
    context: BridgeContext,
) -> Expression:
    """The call of a function that the user writes. Raises `FaultyExpression`."""
    targets = [
        ValueTarget(f"the parameter `{p.name}`", p.type, p.unit) for p in function.parameters
    ]
    fitted = fit_all(arguments, targets, context)
    length = length_of(function.result)
    return Called(node.span, function.result, function.unit, length, function, fitted)


def _number(node: ast.FunctionCall, value: Expression, context: BridgeContext) -> Expression:
    groups = groups_of(value)
    if not all(_is_convertible(group.type) for group in groups):
        _reject(node, value, "a string, number or bool", context)
    if not value.is_list:
        return NumberOf(node.span, DOUBLE, value.unit, None, value)
    doubles = ItemsType(tuple(ItemGroup(DOUBLE, g.unit, g.count) for g in groups))
    return NumberOf(node.span, doubles, value.unit, value.length, value)


def _is_convertible(type_: ValueType) -> bool:
    return isinstance(type_, (Primitive, Enum)) or type_ in NUMBERS


def _reject(node: ast.FunctionCall, value: Expression, takes: str, context: BridgeContext) -> None:
    found = "a list" if value.is_list else a_type(value.type)
    message = f"`{node.name.text}` takes {takes}, not {found}"
    context.fail(codes.FUNCTION_ARGUMENTS, value.span, message)
