"""Topics and services of operations: their names, types and codecs in ROS 1.

In: an interface and an operation. Out: `Ros1Topic` or `Ros1Service`. An operation that ROS cannot
express has a type of its own, which only components know: its md5 is that of its shape.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
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


class Ros1Topic:
    """The topic of a publication or command. `type.counts`: `encode` omits the counter."""

    def __init__(self, name: str, type_: Ros1Type, operation: Operation) -> None:
        self.name = name
        self.type = type_
        self._inputs = operation.inputs

    @cached_property
    def encode(self) -> Callable[[tuple[Any, ...]], bytes]:
        """Arguments to the body of a message; raises `EncodeError`."""
        omits = self.type.counts
        return _limited(encoder_function(self._inputs, "tuple", wire=ROS1, omits_seq=omits))

    @cached_property
    def decode(self) -> Callable[[Any], tuple[Any, ...]]:
        """The body of a message, with the counter, to arguments; raises `MalformedMessage`."""
        return decoder_function(self._inputs, "tuple", ROS1)


class Ros1Service:
    """The service of a query. `is_ros`: programs of ROS know its type."""

    def __init__(self, name: str, type_: Ros1Type, operation: Operation, *, is_ros: bool) -> None:
        self.name = name
        self.type = type_
        self.is_ros = is_ros
        self._operation = operation
        outputs = len(operation.outputs)
        self._form = "tuple" if outputs > 1 else "one" if outputs else "none"

    @cached_property
    def encode_request(self) -> Callable[[tuple[Any, ...]], bytes]:
        """Arguments to bytes; raises `EncodeError`."""
        return _limited(encoder_function(self._operation.inputs, "tuple", wire=ROS1))

    @cached_property
    def decode_request(self) -> Callable[[Any], tuple[Any, ...]]:
        """Bytes to arguments; raises `MalformedMessage`."""
        return decoder_function(self._operation.inputs, "tuple", ROS1)

    @cached_property
    def encode_reply(self) -> Callable[[Any], bytes]:
        """The result of a handler to bytes; raises `EncodeError`."""
        return _limited(encoder_function(self._operation.outputs, self._form, wire=ROS1))

    @cached_property
    def decode_reply(self) -> Callable[[Any], Any]:
        """Bytes to the result of a proxy; raises `MalformedMessage`."""
        return decoder_function(self._operation.outputs, self._form, ROS1)


def topic_of(name: str, interface: Interface, operation: Operation) -> Ros1Topic:
    """The topic of an operation; `name` is that of the port. Raises `InterfaceMismatch`."""
    try:
        type_ = message_types.message_type(topic_type(operation).struct)
    except NotRosType:
        type_ = _own_type(interface, operation)
    return Ros1Topic(operation_name(name, interface, operation), type_, operation)


def service_of(name: str, interface: Interface, operation: Operation) -> Ros1Service:
    """The service of an operation; `name` is that of the port. Raises `InterfaceMismatch`."""
    full_name = operation_name(name, interface, operation)
    try:
        found = service_type(operation)
    except NotRosType:
        return Ros1Service(full_name, _own_type(interface, operation), operation, is_ros=False)
    type_ = message_types.service_type(found.request, found.response)
    return Ros1Service(full_name, type_, operation, is_ros=True)


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
