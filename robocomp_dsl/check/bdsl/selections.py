"""Types selections: `wheels[0]`, `wheels[2,0,1]` and `wheels[0:3]`."""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.items import groups_of, item_at
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.model.bridge_ports import ItemGroup, ItemsType
from robocomp_dsl.model.bridge_values import Expression, Selected, Sliced
from robocomp_dsl.model.types import Struct
from robocomp_dsl.syntax.ast import bdsl as ast


def selection(node: ast.Selection, value: Expression, context: BridgeContext) -> Expression:
    """The selected item or items. Raises `FaultyExpression`."""
    if not value.is_list:
        message = f"`{node.value.span.text}` is no list, but {a_type(value.type)}"
        first = value.type.fields[:1] if isinstance(value.type, Struct) else ()
        help_ = f"select a field: `{node.value.span.text}.{first[0].name}`" if first else ""
        context.fail(codes.INVALID_SELECTION, node.span, message, help_)
    if node.bounds is not None:
        return _sliced(node, value, node.bounds, context)
    _check_range(node, value, max(node.indices), context)
    items = [_item(node, value, index, context) for index in node.indices]
    if len(items) == 1:
        return items[0].replace(span=node.span)
    groups = tuple(ItemGroup(item.type, item.unit) for item in items)
    type_ = ItemsType(groups)
    return Selected(node.span, type_, type_.unit, len(items), value, node.indices)


def _item(node: ast.Selection, value: Expression, index: int, context: BridgeContext) -> Expression:
    item = item_at(value, index)
    if item is None:
        message = f"which value item {index} is depends on lengths that are known at run time only"
        help_ = "declare the lengths of the inputs, as in `double[2]`, or that of the hub"
        context.fail(codes.INVALID_SELECTION, node.span, message, help_)
    return item


def _check_range(
    node: ast.Selection, value: Expression, index: int, context: BridgeContext
) -> None:
    if value.length is not None and index >= value.length:
        last = value.length - 1
        message = f"`{node.value.span.text}` has {value.length} items: there is no item {index}"
        help_ = f"the last item is `{node.value.span.text}[{last}]`" if last >= 0 else ""
        context.fail(codes.VALUE_LENGTH, node.span, message, help_)


def _sliced(
    node: ast.Selection,
    value: Expression,
    bounds: tuple[int | None, int | None],
    context: BridgeContext,
) -> Expression:
    start = bounds[0] or 0
    stop = value.length if bounds[1] is None else bounds[1]
    if stop is not None:
        if start >= stop:
            message = f"`{node.span.text}` selects nothing"
            context.fail(codes.VALUE_LENGTH, node.span, message, "the end is excluded: `[0:3]`")
        _check_range(node, value, stop - 1, context)
    groups = _groups_between(node, value, start, stop, context)
    type_ = ItemsType(groups)
    return Sliced(node.span, type_, type_.unit, type_.count, value, start, stop)


def _groups_between(
    node: ast.Selection, value: Expression, start: int, stop: int | None, context: BridgeContext
) -> tuple[ItemGroup, ...]:
    groups = groups_of(value)
    if len({(group.type, group.unit) for group in groups}) == 1:
        return (groups[0].replace(count=None if stop is None else stop - start),)
    if stop is None:
        stop = start + 1
        _item(node, value, start, context)
        message = f"the end of `{node.span.text}` is known at run time only"
        context.fail(codes.INVALID_SELECTION, node.span, message, "write the end: `[0:3]`")
    items = [_item(node, value, index, context) for index in range(start, stop)]
    return tuple(ItemGroup(item.type, item.unit) for item in items)
