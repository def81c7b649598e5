"""Conditions of actions: comparisons of numbers, strings, bools and enumerators.

In: the tree of a condition. Out: bool expressions, all of which must be true, and findings.
"""

from __future__ import annotations

from typing import NoReturn

from robocomp_dsl.check.bdsl.context import FaultyExpression
from robocomp_dsl.check.bdsl.expressions import typed, value_for
from robocomp_dsl.check.bdsl.scopes import Scope
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.bdsl.units import convert
from robocomp_dsl.check.codes import bridge_actions as codes
from robocomp_dsl.model.bridge_actions import Compared, Condition
from robocomp_dsl.model.bridge_values import Expression
from robocomp_dsl.model.types import BOOL, NUMBERS, Enum, Primitive
from robocomp_dsl.syntax.ast import bdsl as ast

EQUALITY = ("==", "!=")


def resolve_condition(tree: ast.Condition, scope: Scope) -> Condition | None:
    """The comparisons; None if one of them is faulty."""
    resolved = [_comparison(comparison, scope) for comparison in tree.comparisons]
    valid = tuple(comparison for comparison in resolved if comparison is not None)
    return valid if len(valid) == len(resolved) else None


def _comparison(tree: ast.Comparison, scope: Scope) -> Expression | None:
    try:
        left = typed(tree.left, scope)
        if tree.operator is None or tree.right is None:
            return _bool(left, scope)
        if isinstance(left.type, Enum):
            target = ValueTarget(f"`{left.span.text}`", left.type)
            right = value_for(tree.right, target, scope)
        else:
            right = typed(tree.right, scope)
    except FaultyExpression:
        return None
    if right is None:
        return None
    try:
        right = _comparable(tree.operator.text, left, right, scope)
    except FaultyExpression:
        return None
    return Compared(tree.span, BOOL, "", None, tree.operator.text, left, right)


def _bool(value: Expression, scope: Scope) -> Expression:
    if value.type != BOOL:
        _reject_value(value, scope)
    return value


def _reject_value(value: Expression, scope: Scope) -> NoReturn:
    found = "a list" if value.is_list else a_type(value.type)
    message = f"`{value.span.text}` is {found}, which is neither true nor false"
    help_ = f"compare it, as in `{value.span.text} > 0`" if value.type in NUMBERS else ""
    scope.context.fail(codes.CONDITION_TYPE, value.span, message, help_)


def _comparable(operator: str, left: Expression, right: Expression, scope: Scope) -> Expression:
    """`right` in the unit of `left`. Raises `FaultyExpression`."""
    context = scope.context
    for value in (left, right):
        if not isinstance(value.type, (Primitive, Enum)):
            found = "a list" if value.is_list else a_type(value.type)
            help_ = f"select an item, as in `{value.span.text}[0]`" if value.is_list else ""
            message = f"`{operator}` compares single values; this is {found}"
            context.fail(codes.CONDITION_TYPE, value.span, message, help_)
    if _kind(left) != _kind(right):
        message = f"`{left.span.text}` is {a_type(left.type)}, this is {a_type(right.type)}"
        context.fail(codes.CONDITION_TYPE, right.span, message)
    if _kind(left) != "number":
        if operator not in EQUALITY:
            message = f"`{operator}` compares numbers; this is {a_type(left.type)}"
            context.fail(codes.CONDITION_TYPE, left.span, message, "`==` and `!=` compare it")
        return right
    if not left.unit or not right.unit:
        return right
    return convert(right, left.unit, f"`{left.span.text}`", context)


def _kind(value: Expression) -> object:
    """Values of one kind can be compared."""
    type_ = value.type
    if isinstance(type_, Primitive):
        return "number" if type_ in NUMBERS else "text" if type_.is_text else type_
    return type_
