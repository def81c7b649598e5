"""Type hashes of ROS 2 (RIHS01), from REP 2016 and `rosidl_generator_type_description`.

In: structs that were imported from `.msg` and `.srv` files. Out: `RIHS01_` and 64 hexadecimal
digits, equal to the hash that ROS computes.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from robocomp_dsl.runtime.data.schema import (
    Array,
    Primitive,
    Sequence,
    StructArrayBase,
    StructBase,
    Type,
)
from robocomp_dsl.runtime.middleware.ros_common.interface_types import RosService, RosTopic

_TYPE_IDS = {
    "int8": 2,
    "byte": 3,
    "short": 4,
    "uint16": 5,
    "int": 6,
    "uint32": 7,
    "long": 8,
    "uint64": 9,
    "float": 10,
    "double": 11,
    "bool": 15,
    "octet": 16,
    "string": 17,
}
_NESTED, _UINT8, _BOUNDED_STRING = 1, 3, 21
_FIXED, _BOUNDED, _UNBOUNDED = 48, 96, 144


def topic_hash(topic: RosTopic) -> str:
    """The hash of a message type."""
    return _hash(_described(topic.struct), dict(_nested(topic.struct)))


def service_hash(service: RosService) -> str:
    """The hash of a service type, of which rmw_zenoh makes the key."""
    name = service.type_id
    parts = ("Request", "Response", "Event")
    described = _type(
        name, [(f"{part.lower()}_message", _type_of(_NESTED, f"{name}_{part}")) for part in parts]
    )
    bounded = [
        (part.lower(), _type_of(_NESTED + _BOUNDED, f"{name}_{part}", capacity=1))
        for part in parts[:2]
    ]
    info = ("info", _type_of(_NESTED, "service_msgs/msg/ServiceEventInfo"))
    nested = {
        f"{name}_Event": _type(f"{name}_Event", [info, *bounded]),
        "service_msgs/msg/ServiceEventInfo": _type(
            "service_msgs/msg/ServiceEventInfo",
            [
                ("event_type", _type_of(_UINT8)),
                ("stamp", _type_of(_NESTED, "builtin_interfaces/msg/Time")),
                ("client_gid", _type_of(_UINT8 + _FIXED, capacity=16)),
                ("sequence_number", _type_of(8)),
            ],
        ),
        "builtin_interfaces/msg/Time": _type(
            "builtin_interfaces/msg/Time", [("sec", _type_of(6)), ("nanosec", _type_of(7))]
        ),
    }
    for struct in (service.request, service.response):
        nested |= {struct._type_id_: _described(struct), **dict(_nested(struct))}  # type: ignore[attr-defined]
    return _hash(described, nested)


def _hash(described: dict[str, Any], nested: dict[str, dict[str, Any]]) -> str:
    from hashlib import sha256  # noqa: PLC0415 - loads OpenSSL

    text = json.dumps(
        {
            "type_description": described,
            "referenced_type_descriptions": [nested[name] for name in sorted(nested)],
        }
    )
    return f"RIHS01_{sha256(text.encode()).hexdigest()}"


def _described(struct: Any) -> dict[str, Any]:
    fields = [(name, _field(type_)) for name, type_ in struct._fields_]
    empty = [("structure_needs_at_least_one_member", _type_of(_UINT8))]
    return _type(struct._type_id_, fields or empty)


def _type(name: str, fields: list[tuple[str, dict[str, Any]]]) -> dict[str, Any]:
    return {
        "type_name": name,
        "fields": [{"name": field, "type": type_} for field, type_ in fields],
    }


def _type_of(
    type_id: int, nested: str = "", capacity: int = 0, string_capacity: int = 0
) -> dict[str, Any]:
    return {
        "type_id": type_id,
        "capacity": capacity,
        "string_capacity": string_capacity,
        "nested_type_name": nested,
    }


def _field(type_: Type) -> dict[str, Any]:
    match type_:
        case Primitive():
            if type_.bound:
                return _type_of(_BOUNDED_STRING, string_capacity=type_.bound)
            return _type_of(_TYPE_IDS[type_.name])
        case Array() | Sequence():
            element = _field(type_.element)
            kind = _FIXED if type_.size else _BOUNDED if type_.bound else _UNBOUNDED
            capacity = type_.size or type_.bound
            return element | {"type_id": element["type_id"] + kind, "capacity": capacity}
    cls: Any = type_
    if issubclass(cls, StructArrayBase):
        return _type_of(_NESTED + _UNBOUNDED, cls._element_._type_id_)
    return _type_of(_NESTED, cls._type_id_)


def _nested(struct: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """All types within a struct, by name."""
    for _, type_ in struct._fields_:
        inner: Any = type_.element if isinstance(type_, Sequence) else type_
        if isinstance(inner, type) and issubclass(inner, StructArrayBase):
            inner = inner._element_
        if isinstance(inner, type) and issubclass(inner, StructBase):
            yield inner._type_id_, _described(inner)  # type: ignore[attr-defined]
            yield from _nested(inner)
