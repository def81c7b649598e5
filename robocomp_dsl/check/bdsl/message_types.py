"""The type of a message without a declared type: that of its items.

In: a typed value. Out: the type of its message, with structs for lists of different items.
"""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.items import groups_of
from robocomp_dsl.check.bdsl.type_words import type_text
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.model.bridge_ports import TIME, ItemsType, TimeType
from robocomp_dsl.model.bridge_values import Counter, Expression, ListExpression
from robocomp_dsl.model.types import DOUBLE, INT, STRING, Field, Primitive, Sequence, Type


def item_type(value: Expression, name: str, context: BridgeContext) -> Type:
    """The type of an item or message. Raises `FaultyExpression`.

    A time becomes a `double [s]`, `counter` an `int`. A struct that the bridge declares is called
    `name`.
    """
    if isinstance(value, ListExpression):
        fields = tuple(
            Field(
                f"item{index}",
                item_type(item, f"{name}Item{index}", context),
                item.span,
                unit=_unit(item),
            )
            for index, item in enumerate(value.items, 1)
        )
        return context.types.struct(name, fields, value.span)
    if isinstance(value.type, ItemsType):
        return _list_type(value, value.type, name, context)
    if isinstance(value.type, TimeType):
        return DOUBLE
    if isinstance(value, Counter):
        return INT
    if isinstance(value.type, Primitive) and value.type.is_text:
        return STRING
    return _declared(value.type, value, context)


def _declared(type_: Type, value: Expression, context: BridgeContext) -> Type:
    """The type, with a declaration of its own if it is the array of a field of a ROS message."""
    if isinstance(type_, Sequence) and type_.is_anonymous:
        return context.types.sequence(type_.element, 0, value.span)
    return type_


def _unit(item: Expression) -> str:
    return "s" if item.type == TIME else item.unit


def _list_type(value: Expression, items: ItemsType, name: str, context: BridgeContext) -> Type:
    """A hub or selection: a sequence if its items are equal, otherwise a struct."""
    number = items.number
    types = {group.type for group in groups_of(value)}
    if number is not None:
        return context.types.sequence(number, 0, value.span)
    if len(types) == 1:
        only = types.pop()
        if not isinstance(only, (ItemsType, TimeType)):
            return context.types.sequence(only, 0, value.span)
    if items.count is None:
        found = ", ".join(f"`{type_text(group.type)}`" for group in items.groups)
        message = f"the items are {found}, and their number is known at run time only"
        help_ = "select items, as in `{ hub[0], hub[1] }`, or declare the lengths of the inputs"
        context.fail(codes.VALUE_TYPE, value.span, message, help_)
    fields: list[Field] = []
    for group in items.groups:
        for _ in range(group.count or 0):
            index = len(fields) + 1
            kind = DOUBLE if isinstance(group.type, TimeType) else group.type
            if isinstance(kind, ItemsType):
                context.fail(codes.VALUE_TYPE, value.span, "a list in a hub has no type")
            fields.append(Field(f"item{index}", kind, value.span, unit=group.unit))
    return context.types.struct(name, tuple(fields), value.span)
