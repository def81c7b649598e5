"""Types expressions: from the tree to typed expressions, bottom up.

In: an expression of the tree and the names of its scope. Out: a typed expression; a faulty one is
reported and raises `FaultyExpression`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from robocomp_dsl.check.bdsl.arithmetic import arithmetic, negated
from robocomp_dsl.check.bdsl.calls import built_in, user_call
from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.fitting import fit
from robocomp_dsl.check.bdsl.items import field_of, joined_item_type
from robocomp_dsl.check.bdsl.scopes import Scope, reject_field, reject_name
from robocomp_dsl.check.bdsl.selections import selection
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.bdsl.units import convert_to, declared_unit
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.model.bridge_ports import TIME
from robocomp_dsl.model.bridge_values import (
    ConstantValue,
    Expression,
    ListExpression,
    StampOf,
)
from robocomp_dsl.model.types import (
    BOOL,
    DOUBLE,
    INT,
    LONG,
    STRING,
    UINT64,
    Enum,
    Primitive,
    Struct,
)
from robocomp_dsl.syntax.ast import bdsl as ast

BUILT_IN = ("number", "text", "length", "stamp")
_INT_LIMIT = 1 << 31


def value_for(node: ast.Expression, target: ValueTarget, scope: Scope) -> Expression | None:
    """The expression as a value of `target`; None if it is faulty, which is reported."""
    try:
        enumerator = _enumerator(node, target, scope)
        return enumerator or fit(typed(node, scope), target, scope.context)
    except FaultyExpression:
        return None


def fitted(
    node: ast.Expression, value: Expression, target: ValueTarget, scope: Scope
) -> Expression | None:
    """As `value_for`, if the typed expression `value` of `node` is known."""
    try:
        return _enumerator(node, target, scope) or fit(value, target, scope.context)
    except FaultyExpression:
        return None


def typed(node: ast.Expression, scope: Scope) -> Expression:
    """The typed expression. Raises `FaultyExpression`."""
    return _TYPED[type(node)](node, scope)


def typed_all(nodes: Iterable[ast.Expression], scope: Scope) -> tuple[Expression, ...]:
    """All expressions. Raises `FaultyExpression` after all of them were checked."""
    values: list[Expression] = []
    faulty = False
    for node in nodes:
        try:
            values.append(typed(node, scope))
        except FaultyExpression:
            faulty = True
    if faulty:
        raise FaultyExpression
    return tuple(values)


def _literal(node: ast.TextValue | ast.BoolValue, _: Scope) -> Expression:
    type_ = BOOL if isinstance(node, ast.BoolValue) else STRING
    return ConstantValue(node.span, type_, "", None, node.value)


def _number(node: ast.NumberValue, scope: Scope) -> Expression:
    context = scope.context
    type_ = DOUBLE if isinstance(node.value, float) else _integer_type(node.value)
    if type_ is None:
        message = f"`{node.span.text}` exceeds 64 bits"
        context.fail(codes.VALUE_TYPE, node.span, message, f"write `{node.value}.0`")
    unit = declared_unit(node.unit, type_, context.report)
    value = ConstantValue(node.span, type_, unit, None, node.value)
    if unit:
        context.state_unit(value)
    return value


def _integer_type(value: int) -> Primitive | None:
    """The type of an integer, which has no sign."""
    if value < _INT_LIMIT:
        return INT
    if value < _INT_LIMIT << 32:
        return LONG
    return UINT64 if value < _INT_LIMIT << 33 else None


def _list(node: ast.ListValue, scope: Scope) -> Expression:
    items = typed_all(node.items, scope)
    return ListExpression(node.span, joined_item_type(items), "", len(items), items)


def _member(node: ast.Member, scope: Scope) -> Expression:
    if isinstance(node.value, ast.Reference):
        member = scope.member(node.value.name, node.name)
        if member is not None:
            return member.replace(span=node.span)
    value = typed(node.value, scope)
    struct = value.type
    if not isinstance(struct, Struct):
        text = node.value.span.text
        message = f"`{text}` has no fields: it is " + (
            "a list" if value.is_list else a_type(struct)
        )
        help_ = f"select an item first: `{text}[0].{node.name.text}`" if value.is_list else ""
        scope.context.fail(codes.INVALID_SELECTION, node.name.span, message, help_)
    names = [field.name for field in struct.fields]
    if node.name.text not in names:
        reject_field(node.name, f"`{struct.name}`", struct.fields, scope.context)
    return field_of(value, struct.fields[names.index(node.name.text)]).replace(span=node.span)


def _call(node: ast.FunctionCall, scope: Scope) -> Expression:
    name, context = node.name, scope.context
    if name.text == "stamp":
        return _stamp(node, scope)
    if name.text in BUILT_IN:
        _check_count(node, 1, context)
        return built_in(node, typed(node.arguments[0], scope), context)
    if name.text not in context.functions:
        reject_name(name, [*BUILT_IN, *context.functions], context, "function ")
    context.used_names.add(name.text)
    function = context.functions[name.text]
    arguments = typed_all(node.arguments, scope)
    if function is None:
        raise FaultyExpression
    _check_count(node, len(function.parameters), context)
    return user_call(node, function, arguments, context)


def _selection(node: ast.Selection, scope: Scope) -> Expression:
    return selection(node, typed(node.value, scope), scope.context)


def _operation(node: ast.Operation, scope: Scope) -> Expression:
    left, right = typed_all((node.left, node.right), scope)
    return arithmetic(node, left, right, scope.context)


def _negation(node: ast.Negation, scope: Scope) -> Expression:
    return negated(node, typed(node.value, scope), scope.context)


def _conversion(node: ast.Conversion, scope: Scope) -> Expression:
    converted = convert_to(typed(node.value, scope), node.unit, scope.context)
    value = converted.replace(span=node.span)
    scope.context.state_unit(value)
    return value


def _check_count(node: ast.FunctionCall, expected: int, context: BridgeContext) -> None:
    found = len(node.arguments)
    if found != expected:
        arguments = f"{expected} argument{'' if expected == 1 else 's'}"
        message = f"`{node.name.text}` takes {arguments}, not {found}"
        context.fail(codes.FUNCTION_ARGUMENTS, node.span, message)


def _stamp(node: ast.FunctionCall, scope: Scope) -> Expression:
    _check_count(node, 1, scope.context)
    argument = node.arguments[0]
    if not isinstance(argument, ast.Reference):
        message = "the argument of `stamp` is the name of an input"
        help_ = "a time stamp in the message is a field: `imu.header.stamp`"
        scope.context.fail(codes.FUNCTION_ARGUMENTS, argument.span, message, help_)
    return StampOf(node.span, TIME, "", None, scope.input(argument.name))


def _enumerator(node: ast.Expression, target: ValueTarget, scope: Scope) -> Expression | None:
    """A name that is an enumerator of the target, and nothing else in the scope."""
    if not isinstance(node, ast.Reference) or not isinstance(target.type, Enum):
        return None
    if node.name.text in scope.names():
        return None
    names = [enumerator.name for enumerator in target.type.enumerators]
    if node.name.text not in names:
        if nearest(node.name.text, scope.names()) is not None:
            reject_name(node.name, scope.names(), scope.context)
        reject_field(node.name, f"`{target.type.name}`", target.type.enumerators, scope.context)
    return ConstantValue(node.span, target.type, "", None, node.name.text)


_TYPED: dict[type, Callable[[Any, Scope], Expression]] = {
    ast.NumberValue: _number,
    ast.TextValue: _literal,
    ast.BoolValue: _literal,
    ast.ListValue: _list,
    ast.Reference: lambda node, scope: scope.value(node.name),
    ast.Member: _member,
    ast.Selection: _selection,
    ast.FunctionCall: _call,
    ast.Operation: _operation,
    ast.Negation: _negation,
    ast.Conversion: _conversion,
}
