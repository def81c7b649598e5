"""The type hash of ROS 2 messages and services, RIHS01: what ROS 2 peers compare.

In: structs that were imported from `.msg` and `.srv` files; their `type_id` is the ROS name. Out:
`RIHS01_` and 64 hexadecimal digits: the SHA-256 of the JSON text of the type description
(REP-2016; package rosidl_generator_type_description). Constants, defaults and comments are not
part of it.
"""

from __future__ import annotations

import json
from typing import Any, TypeAlias

from robocomp_dsl.runtime.data.schema import (
    BOOL,
    BYTE,
    DOUBLE,
    FLOAT,
    INT,
    INT8,
    LONG,
    OCTET,
    SHORT,
    STRING,
    UINT16,
    UINT32,
    UINT64,
    Array,
    Fields,
    Primitive,
    Sequence,
    StructArrayBase,
    StructBase,
    Type,
)

Description: TypeAlias = dict[str, Any]

_NESTED, _BOUNDED_STRING = 1, 21
_TYPE_IDS = {
    INT8: 2,
    BYTE: 3,
    SHORT: 4,
    UINT16: 5,
    INT: 6,
    UINT32: 7,
    LONG: 8,
    UINT64: 9,
    FLOAT: 10,
    DOUBLE: 11,
    BOOL: 15,
    OCTET: 16,
    STRING: 17,
}
_FIXED, _BOUNDED, _UNBOUNDED = 48, 96, 144
"""What the type id of an array adds to that of its element."""
_EMPTY: Fields = (("structure_needs_at_least_one_member", BYTE),)
"""The member of a message without members: IDL structs cannot be empty."""
_TIME = "builtin_interfaces/msg/Time"
_EVENT_INFO = "service_msgs/msg/ServiceEventInfo"


def message_hash(message: type[StructBase]) -> str:
    """The type hash of a message. Raises `TypeError` for a type that ROS lacks."""
    return _hash(message_description(message))


def service_hash(request: type[StructBase], response: type[StructBase]) -> str:
    """The type hash of the service with these structs. Raises `TypeError` as `message_hash`."""
    return _hash(service_description(request, response))


def message_description(message: type[StructBase]) -> Description:
    """The type description of a message, and of all messages in it, as hashed."""
    descriptions: dict[str, Description] = {}
    _describe(message, descriptions)
    return _with_referenced(_ros_name(message), descriptions)


def service_description(request: type[StructBase], response: type[StructBase]) -> Description:
    """The type description of a service, with the event message that introspection publishes."""
    descriptions: dict[str, Description] = {}
    for part in (request, response):
        _describe(part, descriptions)
    asked, answered = _ros_name(request), _ros_name(response)
    name = asked.removesuffix("_Request")
    if answered != f"{name}_Response":
        raise TypeError(f"{asked} and {answered} are not the two parts of one ROS service")
    _add(descriptions, _TIME, _plain(sec=INT, nanosec=UINT32))
    info = [
        *_plain(event_type=BYTE),
        _field("stamp", _NESTED, nested=_TIME),
        *_plain(client_gid=Array(BYTE, size=16), sequence_number=LONG),
    ]
    _add(descriptions, _EVENT_INFO, info)
    event = [
        _field("info", _NESTED, nested=_EVENT_INFO),
        _field("request", _NESTED + _BOUNDED, capacity=1, nested=asked),
        _field("response", _NESTED + _BOUNDED, capacity=1, nested=answered),
    ]
    _add(descriptions, f"{name}_Event", event)
    parts = {"request": asked, "response": answered, "event": f"{name}_Event"}
    members = [_field(f"{part}_message", _NESTED, nested=of) for part, of in parts.items()]
    _add(descriptions, name, members)
    return _with_referenced(name, descriptions)


def _hash(description: Description) -> str:
    from hashlib import sha256  # noqa: PLC0415 - loads OpenSSL, which types alone do not need

    return f"RIHS01_{sha256(json.dumps(description).encode()).hexdigest()}"


def _with_referenced(name: str, descriptions: dict[str, Description]) -> Description:
    referenced = [descriptions[other] for other in sorted(descriptions) if other != name]
    return {
        "type_description": descriptions[name],
        "referenced_type_descriptions": referenced,
    }


def _ros_name(struct: type[Any]) -> str:
    name = getattr(struct, "_type_id_", "")
    if name.count("/") != 2:
        raise TypeError(f"{struct.__name__} is not imported from a ROS definition")
    return str(name)


def _describe(struct: type[Any], descriptions: dict[str, Description]) -> str:
    """Add the description of a struct and of those in it; returns its name."""
    name = _ros_name(struct)
    if name not in descriptions:
        fields = struct._fields_ or _EMPTY
        _add(descriptions, name, [_member(field, type_, descriptions) for field, type_ in fields])
    return name


def _add(descriptions: dict[str, Description], name: str, fields: list[Description]) -> None:
    descriptions[name] = {"type_name": name, "fields": fields}


def _plain(**fields: Type) -> list[Description]:
    return [_member(name, type_, {}) for name, type_ in fields.items()]


def _member(name: str, type_: Type, descriptions: dict[str, Description]) -> Description:
    element, kind, capacity = type_, 0, 0
    if isinstance(type_, Array | Sequence):
        element, capacity = type_.element, type_.size or type_.bound
        kind = _FIXED if type_.size else _BOUNDED if type_.bound else _UNBOUNDED
    elif isinstance(type_, type) and issubclass(type_, StructArrayBase):
        element, kind = type_._element_, _UNBOUNDED
    if isinstance(element, Primitive):
        if element.bound:
            return _field(name, _BOUNDED_STRING + kind, capacity, element.bound)
        return _field(name, _TYPE_IDS[element] + kind, capacity)
    if isinstance(element, type) and issubclass(element, StructBase):
        return _field(name, _NESTED + kind, capacity, nested=_describe(element, descriptions))
    raise TypeError(f"the field `{name}` has a type that ROS messages lack")


def _field(
    name: str, type_id: int, capacity: int = 0, string_capacity: int = 0, nested: str = ""
) -> Description:
    type_ = {
        "type_id": type_id,
        "capacity": capacity,
        "string_capacity": string_capacity,
        "nested_type_name": nested,
    }
    return {"name": name, "type": type_}
