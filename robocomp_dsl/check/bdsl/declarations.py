"""Inputs, functions and their names.

In: tree nodes. Out: `BridgeInput` and `BridgeFunction` values, and findings.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.bdsl.operations import PortKind, used_operation
from robocomp_dsl.check.bdsl.paths import field_path
from robocomp_dsl.check.bdsl.ports import bridge_port
from robocomp_dsl.check.bdsl.type_refs import resolve_parameters, resolve_type
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.bdsl.types_module import camel_case
from robocomp_dsl.check.bdsl.units import nanoseconds_of
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.codes import bridge_values as value_codes
from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.model.bridge_ports import (
    BridgeFunction,
    BridgeInput,
    BridgePort,
    ItemGroup,
    ItemsType,
    LengthCheck,
)
from robocomp_dsl.model.types import NUMBERS, Field, Sequence, Struct, Type
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name

RESERVED = (
    *("now", "counter", "request", "result", "number", "text", "length", "stamp"),
    *("true", "false"),
)


class _Named(Protocol):
    @property
    def name(self) -> Name: ...


def check_names(
    items: Iterable[_Named], context: BridgeContext, reserved: tuple[str, ...] = ()
) -> set[int]:
    """Report reserved and duplicate names; the `id` of the other items.

    `reserved` are reserved in addition to those of every bridge. Names are compared without case:
    ports become attributes with lower-case names.
    """
    first: dict[str, Name] = {}
    valid: set[int] = set()
    for item in items:
        word = item.name.text.lower()
        if word in RESERVED or word in reserved:
            context.report.add(
                codes.RESERVED_BRIDGE_NAME,
                item.name.span,
                f"`{item.name.text}` has a meaning in expressions",
                help="choose another name",
            )
        elif first.setdefault(word, item.name) is not item.name:
            report_duplicate(item.name, first[word], "declaration", context.report)
        else:
            valid.add(id(item))
    return valid


def resolve_input(tree: ast.Input, context: BridgeContext) -> BridgeInput | None:
    """An input; None if its type or port is faulty."""
    used = used_operation(PortKind.INPUT, tree.name, tree.type, context)
    if used is None:
        return None
    port = bridge_port(PortKind.INPUT, tree.name, tree.place, used, context, tree.qos)
    return input_of(tree, port, context) if port else None


def input_of(tree: ast.Input, port: BridgePort, context: BridgeContext) -> BridgeInput:
    """The input of a resolved port."""
    params = port.operation.inputs
    type_ = params[0].type if len(params) == 1 else None
    groups = ItemsType(tuple(ItemGroup(param.type, param.unit) for param in params))
    return BridgeInput(
        tree.name.text,
        port,
        groups if type_ is None else type_,
        params[0].unit if type_ is not None else "",
        _stamp_path(tree.stamp, port, context),
        tuple(_length_checks(type_, ())) if type_ is not None and port.is_own else (),
        tree.doc,
    )


def _stamp_path(
    path: ast.Path | None, port: BridgePort, context: BridgeContext
) -> tuple[Field, ...]:
    """The field with the time stamp: a ROS `Time`, or a number with a unit of time."""
    if path is None:
        return ()
    resolved = field_path(path, port.operation.inputs, context)
    if resolved is None:
        return ()
    fields = tuple(part for part in resolved.parts if isinstance(part, Field))
    is_time = isinstance(resolved.type, Struct) and resolved.type.name == "Time"
    is_number = resolved.type in NUMBERS and bool(nanoseconds_of(resolved.unit))
    is_field = bool(fields) and len(fields) == len(resolved.parts)
    if not is_field or len(port.operation.inputs) > 1:
        context.report.add(
            value_codes.TIME_TYPE,
            path.span,
            f"`stamp {path.text}` needs a message with fields, as the only parameter",
            help="leave out `stamp`, and use the value in the output",
        )
        return ()
    if is_time or is_number:
        return fields
    context.report.add(
        value_codes.TIME_TYPE,
        path.span,
        f"`{path.text}` is no time stamp, but {a_type(resolved.type)}",
        help="a time stamp is a ROS `Time`, or a number with a unit such as `[s]` or `[ns]`",
    )
    return ()


def _length_checks(type_: Type, path: tuple[Field, ...]) -> Iterable[LengthCheck]:
    """The declared lengths of a type, which the wire does not guarantee."""
    if isinstance(type_, Sequence) and type_.size:
        yield LengthCheck(path, type_.size)
    elif isinstance(type_, Struct):
        for field in type_.fields:
            yield from _length_checks(field.type, (*path, field))


def resolve_function(tree: ast.Function, context: BridgeContext) -> BridgeFunction | None:
    """A function of the user; None if a type is faulty."""
    stem = camel_case(tree.name.text)
    params = resolve_parameters(tree.parameters, stem, context)
    result = resolve_type(tree.result, f"{stem}Result", context)
    if params is None or result is None:
        return None
    for type_ in (*(param.type for param in params), result.type):
        if isinstance(type_, Struct):
            context.types.keep(type_)
    return BridgeFunction(
        tree.name.text, params, result.type, result.unit, tree.name.span, tree.doc
    )
