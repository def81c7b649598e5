"""The names in a bridge and what they stand for: inputs, hubs, functions, requests, replies, fields.

In: the trees and models of a BDSL file. Out: the object behind a name or a path such as
`imu.angular_velocity.z`. Faulty expressions have no model, so this module follows the path itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from robocomp_dsl.model import types
from robocomp_dsl.model.bridge import Bridge, BridgeOutput, BridgeService
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput, ValueType
from robocomp_dsl.model.bridge_values import BridgeCall, BridgeHub, Expression
from robocomp_dsl.model.interface import Operation, Param
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast

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


@dataclass(frozen=True, slots=True)
class Request:
    """The request of a service."""

    service: BridgeService


Named = BridgeInput | BridgeHub | BridgeFunction | BridgeOutput | BridgeService | BridgeCall


class BridgeNames:
    """The declarations of some versions of one bridge; the first version that has a name counts."""

    def __init__(self, bridges: Sequence[Bridge]) -> None:
        self._bridges = bridges

    def values(self) -> dict[str, BridgeInput | BridgeHub]:
        """The inputs and hubs by name."""
        named: dict[str, BridgeInput | BridgeHub] = {}
        for bridge in self._bridges:
            declared: list[BridgeInput | BridgeHub] = [*bridge.inputs, *bridge.hubs]
            for value in declared:
                named.setdefault(value.name, value)
        return named

    def functions(self) -> dict[str, BridgeFunction]:
        """The functions of the user by name."""
        return {f.name: f for bridge in reversed(self._bridges) for f in bridge.functions}

    def outputs(self) -> dict[str, BridgeOutput]:
        """The outputs by name."""
        return {o.name: o for bridge in reversed(self._bridges) for o in bridge.outputs}

    def services(self) -> dict[str, BridgeService]:
        """The services by name."""
        return {s.name: s for bridge in reversed(self._bridges) for s in bridge.services}

    def calls(self, service: str) -> dict[str, BridgeCall]:
        """The calls of a service by name."""
        own = self.services().get(service)
        return {call.name: call for call in own.calls} if own else {}

    def root(self, name: str, service: str = "") -> object:
        """What a name in an expression stands for; None if it is unknown or has no fields."""
        if not service:
            return self.values().get(name)
        own = self.services().get(service)
        return Request(own) if own and name == "request" else self.calls(service).get(name)

    def resolve(self, expression: ast.Expression, service: str = "") -> object:
        """The object or type of an expression that is a path; None for any other."""
        match expression:
            case ast.Reference(name=name):
                return self.root(name.text, service)
            case ast.Member(value=value, name=name):
                member = member_of(self.resolve(value, service), name.text)
                return member.type if member else None
            case ast.Selection(value=value, indices=indices):
                selected = self.resolve(value, service)
                return element_of(selected) if len(indices) == 1 else selected
        return None


def member_of(owner: object, name: str) -> BridgeMember | None:
    """The member of that name."""
    return next((member for member in members_of(owner) if member.name == name), None)


def element_of(owner: object) -> object:
    """The type of one item of a sequence; None for anything else."""
    if isinstance(owner, BridgeInput) and len(owner.parameters) == 1:
        owner = owner.parameters[0].type
    return owner.element if isinstance(owner, types.Sequence) else None


def members_of(owner: object) -> Iterator[BridgeMember]:
    """What may follow the dot behind an input, a request, a reply, or a value of a struct."""
    match owner:
        case BridgeInput(port=port):
            yield from request_members(port.operation)
        case Request(service=service):
            yield from request_members(service.port.operation)
        case BridgeCall(port=port):
            yield from reply_members(port.operation)
        case types.Struct(fields=fields, name=name):
            for field in fields:
                unit = field.unit
                yield BridgeMember(field.name, field.type, unit, field.span, field, name)


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


def expressions_of(bridge: Bridge) -> Iterator[Expression]:
    """All typed expressions of a bridge, the outermost first."""
    calls = [call for service in bridge.services for call in service.calls]
    built = [value for output in bridge.outputs for value in output.arguments]
    built += [value for call in calls for value in call.arguments]
    built += [value for service in bridge.services for value in service.reply]
    roots = [value for hub in bridge.hubs for value in hub.values]
    roots += [value.value for value in built if value.value is not None]
    roots += [assignment.value for value in built for assignment in value.assignments]
    for root in roots:
        yield from root.walk()
