"""Paths of fields: `header.stamp`, `points[0]`, `speed.linear`.

In: a path and the parameters of an operation. Out: the fields, with the type and unit of the last.
"""

from __future__ import annotations

from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.scopes import reject_field
from robocomp_dsl.check.bdsl.target import ValueTarget
from robocomp_dsl.check.bdsl.type_words import a_type
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.model.interface import Param
from robocomp_dsl.model.types import Field, Sequence, Struct, Type
from robocomp_dsl.record import Record
from robocomp_dsl.syntax.ast import bdsl as ast


class ResolvedPath(Record):
    """A path: the parameter, then fields and indices; `type` and `unit` are those of its end."""

    param: Param
    parts: tuple[Field | int, ...]
    type: Type
    unit: str
    text: str

    @property
    def target(self) -> ValueTarget:
        """The end of the path as a target."""
        return ValueTarget(f"`{self.text}`", self.type, self.unit)


def field_path(
    path: ast.Path, params: tuple[Param, ...], context: BridgeContext
) -> ResolvedPath | None:
    """The path in the parameters; it starts with a field if there is one parameter, a struct."""
    try:
        return _resolve(path, params, context)
    except FaultyExpression:
        return None


def _resolve(path: ast.Path, params: tuple[Param, ...], context: BridgeContext) -> ResolvedPath:
    first, *rest = path.parts
    only = params[0] if len(params) == 1 else None
    if only is not None and isinstance(only.type, Struct):
        fields = [field.name for field in only.type.fields]
        if first.name.text in fields or first.name.text != only.name or not rest:
            return _follow(
                path, only, list(path.parts), ValueTarget("", only.type, only.unit), context
            )
    names = [param.name for param in params]
    if first.name.text not in names:
        reject_field(first.name, "the message" if only else "the operation", params, context)
    param = params[names.index(first.name.text)]
    target = ValueTarget("", param.type, param.unit)
    parts: list[Field | int] = []
    target = _indexed(first, target, parts, context)
    resolved = _follow(path, param, rest, target, context)
    return resolved.replace(parts=(*parts, *resolved.parts))


def _follow(
    path: ast.Path,
    param: Param,
    parts: list[ast.PathPart],
    target: ValueTarget,
    context: BridgeContext,
) -> ResolvedPath:
    resolved: list[Field | int] = []
    for part in parts:
        struct = target.type
        if not isinstance(struct, Struct):
            message = f"{a_type(struct)} has no field `{part.name.text}`"
            context.fail(codes.INVALID_SELECTION, part.name.span, message)
        names = [field.name for field in struct.fields]
        if part.name.text not in names:
            reject_field(part.name, f"`{struct.name}`", struct.fields, context)
        field = struct.fields[names.index(part.name.text)]
        resolved.append(field)
        target = _indexed(part, target.field(field), resolved, context)
    return ResolvedPath(param, tuple(resolved), target.type, target.unit, path.text)


def _indexed(
    part: ast.PathPart,
    target: ValueTarget,
    resolved: list[Field | int],
    context: BridgeContext,
) -> ValueTarget:
    """The target, or the item that the index of `part` selects."""
    if part.index is None:
        return target
    index = int(part.index.value)
    sequence = target.type
    name = part.name.text
    if not isinstance(sequence, Sequence):
        message = f"`{name}` is no list, but {a_type(sequence)}"
        context.fail(codes.INVALID_SELECTION, part.index.span, message)
    if not sequence.size:
        message = f"`{name}` has no item {index}: it is empty until it is assigned"
        context.fail(codes.VALUE_LENGTH, part.index.span, message, f"write `{name} = {{ … }};`")
    if index >= sequence.size:
        message = f"`{name}` has {sequence.size} items: there is no item {index}"
        context.fail(codes.VALUE_LENGTH, part.index.span, message)
    resolved.append(index)
    return target.item(sequence)
