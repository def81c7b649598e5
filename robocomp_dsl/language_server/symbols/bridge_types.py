"""The fields that a written type of a bridge has, also of a declaration with errors.

In: a type of the tree and the import scope. Out: its members. The model lacks declarations with
errors, and a file usually has some while the user types.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.model import types
from robocomp_dsl.model.bridge_ports import BridgeInput, ValueType
from robocomp_dsl.model.interface import Interface, Operation, Param
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, QualifiedName

RESULT = "result"
"""The name of the result of a call and of a service, beside the out parameters."""


@dataclass(frozen=True, slots=True)
class BridgeMember:
    """What may follow a dot: a field, a parameter, or the result of an operation."""

    name: str
    type: ValueType | None
    unit: str
    span: Span
    model_object: object
    container: str


class DeclaredTypes:
    """The members of types that a bridge writes."""

    def __init__(self, scope: ImportScope) -> None:
        self._scope = scope

    def message(self, ref: ast.TypeRef) -> tuple[BridgeMember, ...]:
        """The fields of a message: of a struct, or the parameters of an operation."""
        if ref.shape is not None:
            return () if ref.lengths else tuple(map(self._shape_member, ref.shape))
        operation = self._operation(ref)
        if operation:
            return tuple(request_members(operation))
        return tuple(members_of(self._struct(ref.name))) if not ref.lengths else ()

    def request(self, ref: ast.TypeRef) -> tuple[BridgeMember, ...]:
        """The fields of a request, or the parameters of an operation."""
        operation = self._operation(ref)
        if operation:
            return tuple(request_members(operation))
        return tuple(members_of(self._struct(_part(ref.name, "Request"))))

    def reply(self, ref: ast.TypeRef) -> tuple[BridgeMember, ...]:
        """The fields of a response, or the result and the out parameters of an operation."""
        operation = self._operation(ref)
        if operation:
            return tuple(reply_members(operation))
        return tuple(members_of(self._struct(_part(ref.name, "Response"))))

    def action_part(self, ref: ast.TypeRef, part: str) -> tuple[BridgeMember, ...]:
        """The fields of the `Goal`, `Result` or `Feedback` of an action."""
        return tuple(members_of(self._struct(_part(ref.name, part))))

    def action_messages(self, ref: ast.TypeRef) -> tuple[BridgeMember, ...]:
        """What an action assigns: its feedback and its result."""
        return tuple(
            BridgeMember(part.lower(), struct, "", struct.span, None, "")
            for part in ("Feedback", "Result")
            if (struct := self._struct(_part(ref.name, part))) is not None
        )

    def _operation(self, ref: ast.TypeRef) -> Operation | None:
        if ref.operation is None or ref.name is None:
            return None
        interfaces = self._scope.lookup(ref.name, Interface)
        operations = interfaces[0].operations if interfaces else ()
        return next((o for o in operations if o.name == ref.operation.text), None)

    def _struct(self, name: QualifiedName | None) -> types.Struct | None:
        found = self._scope.lookup(name, types.Struct) if name else ()
        return found[0] if found else None

    def _shape_member(self, field: ast.ShapeField) -> BridgeMember:
        ref, name = field.type, field.name
        unit = ref.unit.text if ref.unit else ""
        base: ValueType | None = None
        if ref.name and not ref.lengths:
            base = types.PRIMITIVES.get(ref.name.text) or self._struct(ref.name)
        return BridgeMember(name.text, base, unit, name.span, None, "")


def members_of(owner: object) -> Iterator[BridgeMember]:
    """What may follow the dot behind an input, a request, a reply, or a value of a struct."""
    match owner:
        case tuple():
            yield from owner
        case BridgeInput(port=port):
            yield from request_members(port.operation)
        case types.Struct(fields=fields, name=name):
            for field in fields:
                unit = field.unit
                yield BridgeMember(field.name, field.type, unit, field.span, field, name)


def member_of(owner: object, name: str) -> BridgeMember | None:
    """The member of that name."""
    return next((member for member in members_of(owner) if member.name == name), None)


def element_of(owner: object) -> object:
    """The type of one item of a sequence; None for anything else."""
    if isinstance(owner, BridgeInput) and len(owner.parameters) == 1:
        owner = owner.parameters[0].type
    return owner.element if isinstance(owner, types.Sequence) else None


def request_members(operation: Operation) -> Iterator[BridgeMember]:
    """The fields of a message or request: the parameters, or the fields of the only one."""
    yield from _of_parameters(operation.inputs, operation)


def reply_members(operation: Operation) -> Iterator[BridgeMember]:
    """The fields of a reply: the result and the out parameters, or the fields of the only one."""
    result = operation.result
    first = (Param(RESULT, result, operation.span),) if result is not None else ()
    yield from _of_parameters((*first, *operation.outputs), operation)


def _of_parameters(parameters: Sequence[Param], operation: Operation) -> Iterator[BridgeMember]:
    if len(parameters) == 1:
        yield from members_of(parameters[0].type)
    for parameter in parameters:
        is_result = parameter.span == operation.span
        model = operation if is_result else parameter
        yield BridgeMember(
            parameter.name, parameter.type, parameter.unit, parameter.span, model, operation.name
        )


def _part(name: QualifiedName | None, part: str) -> QualifiedName | None:
    """The name of the request or response of the ROS service `name`."""
    if name is None:
        return None
    own = Name(name.name.span, f"{name.name.text}_{part}")
    return QualifiedName(name.span, own, name.module)
