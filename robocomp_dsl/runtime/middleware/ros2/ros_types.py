"""The classes of rclpy for the types of operations.

In: `package/msg/Name` and the struct that was imported from it. Out: the class of rclpy, if it has
the same definition; otherwise an error that names the field which differs.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from robocomp_dsl.runtime.data.schema import (
    Array,
    Primitive,
    Sequence,
    StructArrayBase,
    StructBase,
    Type,
)
from robocomp_dsl.runtime.errors import InterfaceMismatch, MiddlewareError
from robocomp_dsl.runtime.middleware.ros_common.interface_types import (
    RosService,
    RosTopic,
    ros_type_id,
)

_NAMES = {
    "bool": "boolean",
    "byte": "uint8",
    "short": "int16",
    "int": "int32",
    "long": "int64",
}
"""Types whose name differs; float, double, string, octet, int8, uint16 … have the same."""


def message_class(topic: RosTopic, port: str) -> Any:
    """The class of a message. Raises `MiddlewareError` or `InterfaceMismatch`."""
    cls = _load(topic.type_id, port)
    _check(topic.struct, cls, port)
    return cls


def service_class(service: RosService, port: str) -> Any:
    """The class of a service. Raises `MiddlewareError` or `InterfaceMismatch`."""
    cls = _load(service.type_id, port)
    _check(service.request, cls.Request, port)
    _check(service.response, cls.Response, port)
    return cls


def _load(type_id: str, port: str) -> Any:
    package, kind, name = type_id.split("/")
    try:
        return getattr(import_module(f"{package}.{kind}"), name)
    except (ImportError, AttributeError) as error:
        raise MiddlewareError(
            f"{port}: ROS has no type {type_id} here ({error}); source the workspace that has"
            f" {package}, or run: pip install ros-kilted-{package.replace('_', '-')}"
        ) from None


def _check(struct: type[StructBase], cls: Any, port: str) -> None:
    """Raise `InterfaceMismatch` if the definitions differ; their CDR would, too."""
    ours = {name: _text(type_) for name, type_ in struct._fields_}
    theirs = dict(cls.get_fields_and_field_types())
    name = ros_type_id(struct)
    if list(ours) != list(theirs):
        raise InterfaceMismatch(
            f"{port}: {name} has the fields {', '.join(ours) or 'none'} here,"
            f" {', '.join(theirs) or 'none'} in ROS; import the .msg or .srv file again"
        )
    for field, type_ in struct._fields_:
        if ours[field] != theirs[field]:
            raise InterfaceMismatch(
                f"{port}: {name}.{field} is {ours[field]} here, {theirs[field]} in ROS;"
                " import the .msg or .srv file again"
            )
        nested = _nested(type_)
        if nested is not None:
            _check(nested, _load(ros_type_id(nested), port), port)


def _nested(type_: Type) -> type[StructBase] | None:
    inner: Any = type_.element if isinstance(type_, Sequence) else type_
    if isinstance(inner, type) and issubclass(inner, StructArrayBase):
        inner = inner._element_
    return inner if isinstance(inner, type) and issubclass(inner, StructBase) else None


def _text(type_: Type) -> str:
    """The type as `get_fields_and_field_types` has it: `sequence<double>`, `std_msgs/Header`."""
    match type_:
        case Primitive():
            bound = f"<{type_.bound}>" if type_.bound else ""
            return f"{_NAMES.get(type_.name, type_.name)}{bound}"
        case Array() | Sequence():
            element = _text(type_.element)
            if type_.size:
                return f"{element}[{type_.size}]"
            return f"sequence<{element}{f', {type_.bound}' if type_.bound else ''}>"
    cls: Any = type_
    if issubclass(cls, StructArrayBase):
        return f"sequence<{_text(cls._element_)}>"
    package, _, name = ros_type_id(cls).split("/")
    return f"{package}/{name}"
