"""The DDS type of a ROS message, which Cyclone DDS matches with other participants.

In: a struct that was imported from a `.msg` file. Out: a class of cyclonedds with its fields. Its
objects carry encoded messages: the codec of this project encodes them, twenty times as fast as the
one of cyclonedds in Python.
"""

from __future__ import annotations

from typing import Any

from cyclonedds.idl import make_idl_struct
from cyclonedds.idl.types import (
    array,
    bounded_str,
    float32,
    float64,
    int8,
    int16,
    int32,
    int64,
    sequence,
    uint8,
    uint16,
    uint32,
    uint64,
)
from cyclonedds.idl.types import byte as octet

from robocomp_dsl.runtime.data.schema import (
    Array,
    Primitive,
    Sequence,
    StructArrayBase,
    Type,
)
from robocomp_dsl.runtime.middleware.ros_common.interface_types import RosTopic, ros_type_id

_PRIMITIVES: dict[str, Any] = {
    "bool": bool,
    "byte": uint8,
    "octet": octet,
    "int8": int8,
    "short": int16,
    "uint16": uint16,
    "int": int32,
    "uint32": uint32,
    "long": int64,
    "uint64": uint64,
    "float": float32,
    "double": float64,
}


def dds_type_name(type_id: str) -> str:
    """`std_msgs::msg::dds_::String_` for `std_msgs/msg/String`."""
    package, kind, name = type_id.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def message_type(topic: RosTopic) -> Any:
    """A class of cyclonedds whose objects have the attribute `payload`, an encoded message."""
    class_ = _struct(topic.struct)
    # Cyclone DDS only calls these: what it knows of the type is in other attributes of the class.
    class_.__init__ = _set_payload
    class_.serialize = _payload
    class_.deserialize = class_.deserialize_key = classmethod(_received)
    return class_


def _set_payload(message: Any, payload: bytes) -> None:
    message.payload = payload


def _payload(message: Any, *_: Any, **_options: Any) -> Any:
    """What a writer sends."""
    return message.payload


def _received(class_: Any, data: bytes, *_: Any, **_options: Any) -> Any:
    """What a reader returns."""
    return class_(data)


def _struct(struct: Any) -> Any:
    fields: dict[str, Any] = {name: _field(type_) for name, type_ in struct._fields_}
    # As in ROS, which has no empty messages either.
    fields = fields or {"structure_needs_at_least_one_member": uint8}
    name = dds_type_name(ros_type_id(struct))
    return make_idl_struct(name.rpartition("::")[2], name, fields)


def _field(type_: Type) -> Any:
    match type_:
        case Primitive():
            if type_.code:
                return _PRIMITIVES[type_.name]
            return bounded_str[type_.bound] if type_.bound else str
        case Array() | Sequence():
            element = _field(type_.element)
            if type_.size:
                return array[element, type_.size]
            return sequence[element, type_.bound] if type_.bound else sequence[element]
    cls: Any = type_
    if issubclass(cls, StructArrayBase):
        return sequence[_struct(cls._element_)]
    return _struct(cls)
