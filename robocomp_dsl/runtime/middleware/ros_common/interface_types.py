"""Which ROS type an operation is.

In: interfaces whose structs were imported from `.msg` and `.srv` files. Out: the message or service
type of each operation, or the reasons why ROS cannot express it. A publication or a command with
one input is the message that it carries; a query from the request to the response of one `.srv`
file is that service.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.runtime.component.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.data.schema import (
    Dictionary,
    Enum,
    Fields,
    Sequence,
    StructArrayBase,
    StructBase,
    Type,
)
from robocomp_dsl.runtime.errors import MiddlewareError

_TYPE_ID = re.compile(r"[a-z][a-z0-9_]*/(msg|srv|action)/[A-Za-z][A-Za-z0-9_]*")
_REQUEST, _RESPONSE = "_Request", "_Response"
_TOPIC_PATTERNS = (Pattern.COMMAND, Pattern.PUBLISH)


class NotRosType(MiddlewareError):
    """ROS has no type for an operation; the message says why and what to do."""


@dataclass(frozen=True, slots=True)
class RosTopic:
    """A message type, `package/msg/Name`, and the struct that was imported from it."""

    type_id: str
    struct: type[StructBase]


@dataclass(frozen=True, slots=True)
class RosService:
    """A service type, `package/srv/Name`, and the structs of its request and response."""

    type_id: str
    request: type[StructBase]
    response: type[StructBase]


def ros_type_id(type_: object) -> str:
    """`package/msg/Name` of a struct that was imported from ROS; "" for any other type."""
    type_id = getattr(type_, "_type_id_", "")
    return type_id if _TYPE_ID.fullmatch(type_id) else ""


def is_topic(operation: Operation, *, published: bool) -> bool:
    """Whether an operation is a topic in ROS; `published`: of a published or subscribed port."""
    return published or operation.pattern in _TOPIC_PATTERNS


def topic_type(operation: Operation) -> RosTopic:
    """The message type of a publication or command. Raises `NotRosType`."""
    if operation.outputs or operation.throws:
        raise NotRosType(f"{operation.name}: a ROS topic has no result and no exceptions")
    struct = _struct(operation, operation.inputs, "input")
    return RosTopic(ros_type_id(struct), struct)


def service_type(operation: Operation) -> RosService:
    """The service type of a query. Raises `NotRosType`."""
    if operation.throws:
        raise NotRosType(
            f"{operation.name}: it throws {operation.throws[0].__name__}, but a ROS service has no"
            " exceptions; report failures in the response"
        )
    request = _struct(operation, operation.inputs, "input")
    response = _struct(operation, operation.outputs, "result")
    asked, answered = ros_type_id(request), ros_type_id(response)
    name = asked.removesuffix(_REQUEST)
    if "/srv/" not in asked or asked == name or answered != name + _RESPONSE:
        raise NotRosType(
            f"{operation.name}: {asked} and {answered} are not request and response of one ROS"
            " service; import both from the same .srv file"
        )
    return RosService(name, request, response)


def check_interface(interface: Interface, *, published: bool = False) -> list[str]:
    """The reasons why ROS cannot express `interface`, one per operation; empty if it can.

    `published`: as a topic, not as a service.
    """
    reasons = []
    for operation in interface.published if published else interface.operations:
        try:
            if is_topic(operation, published=published):
                topic_type(operation)
            else:
                service_type(operation)
        except NotRosType as error:
            reasons.append(str(error))
    return reasons


def require_ros_types(interface: Interface, port: str, *, published: bool) -> None:
    """Raise `NotRosType` with all reasons of `check_interface`."""
    if reasons := check_interface(interface, published=published):
        raise NotRosType(
            f"{port}: ROS 2 cannot express {interface.name}: {'; '.join(reasons)}."
            " Use another middleware for this port, or ROS message types"
        )


def _struct(operation: Operation, fields: Fields, role: str) -> type[StructBase]:
    """The type of the only field, a struct of ROS. Raises `NotRosType`."""
    if len(fields) != 1:
        raise NotRosType(
            f"{operation.name}: it has {len(fields)} {role}s instead of one that is a ROS message"
        )
    type_: Any = fields[0][1]
    if not (isinstance(type_, type) and issubclass(type_, StructBase)):
        raise NotRosType(f"{operation.name}: its {role} is no ROS message")
    if not ros_type_id(type_):
        raise NotRosType(
            f"{operation.name}: its {role} {type_.__name__} is not imported from a .msg or .srv"
            " file"
        )
    for name, field in type_._fields_:
        if reason := _unknown(field):
            raise NotRosType(f"{operation.name}: {type_.__name__}.{name} is {reason}")
    return type_


def _unknown(type_: Type) -> str:
    """Why ROS lacks a type of a field, "" if it has it."""
    if isinstance(type_, Dictionary):
        return "a dictionary, which ROS messages lack"
    if isinstance(type_, Sequence):
        return _unknown(type_.element)
    if not isinstance(type_, type):
        return ""
    if issubclass(type_, Enum):
        return "an enum, which ROS messages lack"
    struct = type_._element_ if issubclass(type_, StructArrayBase) else type_
    if not ros_type_id(struct):
        return f"of type {struct.__name__}, which is not imported from a .msg file"
    return next((reason for _, field in struct._fields_ if (reason := _unknown(field))), "")
