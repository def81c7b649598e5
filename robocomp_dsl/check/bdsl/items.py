"""Items of lists: their types, units and number.

In: typed expressions. Out: expressions for single items, and the items of concatenated values.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.bdsl.units import has_numbers
from robocomp_dsl.model.bridge_ports import ItemGroup, ItemsType, ValueType
from robocomp_dsl.model.bridge_values import Expression, FieldOf, ItemAt, ListExpression
from robocomp_dsl.model.types import Dictionary, Field, Sequence, Struct


def same_type(first: ValueType, second: ValueType) -> bool:
    """Whether values of both types are the same data; lengths are compared elsewhere."""
    if isinstance(first, Sequence) and isinstance(second, Sequence):
        return same_type(first.element, second.element)
    if isinstance(first, Dictionary) and isinstance(second, Dictionary):
        return same_type(first.key, second.key) and same_type(first.value, second.value)
    return first == second


def groups_of(value: Expression) -> tuple[ItemGroup, ...]:
    """The items of a list."""
    if isinstance(value.type, ItemsType):
        return value.type.groups
    if isinstance(value.type, Sequence):
        return (ItemGroup(value.type.element, value.unit, value.length),)
    return (ItemGroup(value.type, value.unit),)


def item_at(value: Expression, index: int) -> Expression | None:
    """The item `index`; None if its type is known at run time only."""
    group = _group_at(groups_of(value), index, value.length)
    if group is None:
        return None
    if isinstance(value, ListExpression) and index < len(value.items):
        return value.items[index]
    return typed_item(value, index, group)


def typed_item(value: Expression, index: int, group: ItemGroup) -> ItemAt:
    """The item `index`, whose type is that of `group`."""
    return ItemAt(value.span, group.type, group.unit, length_of(group.type), value, index)


def length_of(type_: ValueType) -> int | None:
    """The number of items that every value of a type has; None if it varies."""
    if isinstance(type_, ItemsType):
        return type_.count
    return type_.size or None if isinstance(type_, Sequence) else None


def items_of(value: Expression) -> list[Expression] | None:
    """All items of a list; None if their number or types are known at run time only."""
    if value.length is None:
        return None
    items = [item_at(value, index) for index in range(value.length)]
    known = [item for item in items if item is not None]
    return known if len(known) == len(items) else None


def struct_items(value: Expression, struct: Struct) -> ListExpression:
    """The fields of a struct as a list."""
    fields = tuple(field_of(value, field) for field in struct.fields)
    return ListExpression(value.span, joined_item_type(fields), "", len(fields), fields)


def field_of(value: Expression, field: Field) -> FieldOf:
    """A field of a struct; it has the unit of the struct if it has none of its own."""
    unit = field.unit or (value.unit if has_numbers(field.type) else "")
    return FieldOf(value.span, field.type, unit, length_of(field.type), value, field)


def joined_type(values: Iterable[Expression]) -> ItemsType:
    """The type of concatenated values."""
    return ItemsType(tuple(group for value in values for group in groups_of(value)))


def joined_item_type(items: Iterable[Expression]) -> ItemsType:
    """The type of `{ a, b }`: each value is one item, also if it is a list."""
    return ItemsType(tuple(ItemGroup(item.type, item.unit) for item in items))


def with_count(type_: ItemsType, count: int) -> ItemsType:
    """The type for a total of `count` items: the length of a single unknown group follows."""
    unknown = [group for group in type_.groups if group.count is None]
    if len(unknown) != 1:
        return type_
    rest = count - sum(group.count or 0 for group in type_.groups)
    groups = (g.replace(count=max(rest, 0)) if g is unknown[0] else g for g in type_.groups)
    return ItemsType(tuple(groups))


def _group_at(groups: tuple[ItemGroup, ...], index: int, total: int | None) -> ItemGroup | None:
    if total is not None and len(groups) > 1:
        groups = with_count(ItemsType(groups), total).groups
    if len({(group.type, group.unit) for group in groups}) == 1:
        return groups[0]
    for group in groups:
        if group.count is None:
            return None
        if index < group.count:
            return group
        index -= group.count
    return None
