"""Topics and services of operations: their names, types and codecs in ROS 1.

In: an interface and an operation. Out: `Ros1Topic` or `Ros1Service`. An operation that ROS cannot
express has a type of its own, which only components know: its md5 is that of its shape.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from hashlib import md5
from typing import Any

from robocomp_dsl.runtime.codec.decoder import decoder_function
from robocomp_dsl.runtime.codec.encoder import encoder_function
from robocomp_dsl.runtime.codec.wire_profile import ROS1
from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.errors import EncodeError
from robocomp_dsl.runtime.middleware.ros1 import message_types
from robocomp_dsl.runtime.middleware.ros1.description import MAX_MESSAGE_BYTES
from robocomp_dsl.runtime.middleware.ros1.message_types import Ros1Type
from robocomp_dsl.runtime.middleware.ros_common.interface_types import (
    NotRosType,
    service_type,
    topic_type,
)
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name

_PACKAGE = "robocomp_dsl"


@dataclass(frozen=True, slots=True)
class Ros1Topic:
    """The topic of a publication or command. `encode` omits the counter of a header."""

    name: str
    type: Ros1Type
    encode: Callable[[tuple[Any, ...]], bytes]
    decode: Callable[[Any], tuple[Any, ...]]


@dataclass(frozen=True, slots=True)
class Ros1Service:
    """The service of a query. `is_ros`: programs of ROS know its type."""

    name: str
    type: Ros1Type
    is_ros: bool
    encode_request: Callable[[tuple[Any, ...]], bytes]
    decode_request: Callable[[Any], tuple[Any, ...]]
    encode_reply: Callable[[Any], bytes]
    decode_reply: Callable[[Any], Any]


def topic_of(name: str, interface: Interface, operation: Operation) -> Ros1Topic:
    """The topic of an operation; `name` is that of the port. Raises `InterfaceMismatch`."""
    try:
        type_ = message_types.message_type(topic_type(operation).struct)
    except NotRosType:
        type_ = _own_type(interface, operation)
    encode = encoder_function(operation.inputs, "tuple", wire=ROS1, omits_seq=type_.counts)
    decode = decoder_function(operation.inputs, "tuple", ROS1)
    return Ros1Topic(operation_name(name, interface, operation), type_, _limited(encode), decode)


def service_of(name: str, interface: Interface, operation: Operation) -> Ros1Service:
    """The service of an operation; `name` is that of the port. Raises `InterfaceMismatch`."""
    try:
        found = service_type(operation)
    except NotRosType:
        type_, is_ros = _own_type(interface, operation), False
    else:
        type_, is_ros = message_types.service_type(found.request, found.response), True
    outputs = operation.outputs
    form = "tuple" if len(outputs) > 1 else "one" if outputs else "none"
    return Ros1Service(
        operation_name(name, interface, operation),
        type_,
        is_ros,
        _limited(encoder_function(operation.inputs, "tuple", wire=ROS1)),
        decoder_function(operation.inputs, "tuple", ROS1),
        _limited(encoder_function(outputs, form, wire=ROS1)),
        decoder_function(outputs, form, ROS1),
    )


def _own_type(interface: Interface, operation: Operation) -> Ros1Type:
    """The type of an operation that ROS cannot express."""
    shape = f"{interface.name} {operation.shape}"
    name = f"{_PACKAGE}/{interface.name.replace('::', '_')}_{operation.name}"
    digest = md5(shape.encode(), usedforsecurity=False).hexdigest()
    return Ros1Type(name, digest, f"# {shape}\n")


def _limited(encode: Callable[[Any], bytes]) -> Callable[[Any], bytes]:
    def limited(values: Any) -> bytes:
        data = encode(values)
        if len(data) > MAX_MESSAGE_BYTES:
            raise EncodeError(f"a message has at most {MAX_MESSAGE_BYTES} bytes")
        return data

    return limited
