"""The ROS 1 types of structs: name, md5 and definition, which peers compare.

In: structs that were imported from `.msg` and `.srv` files in the form of ROS 2. Out: `Ros1Type`,
or `InterfaceMismatch` if ROS 1 defines the type otherwise. Known types are those of ROS Noetic in
the library rosbags; others are those of `definitions`, or follow from the struct (genmsg).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from hashlib import md5
from typing import Any

from robocomp_dsl.runtime.data.per_class_cache import once
from robocomp_dsl.runtime.data.schema import (
    BYTE,
    DOUBLE,
    FLOAT,
    INT,
    LONG,
    OCTET,
    SHORT,
    Array,
    Primitive,
    Sequence,
    StructArrayBase,
    StructBase,
    Type,
)
from robocomp_dsl.runtime.errors import InterfaceMismatch
from robocomp_dsl.runtime.middleware.ros1.definitions import Definition, find_definition

_BUILT_IN = {
    "builtin_interfaces/msg/Time": "time",
    "builtin_interfaces/msg/Duration": "duration",
}
_NAMES = {
    BYTE: "uint8",
    OCTET: "byte",
    SHORT: "int16",
    INT: "int32",
    LONG: "int64",
    FLOAT: "float32",
    DOUBLE: "float64",
}
_SAME_BITS = {"char": "uint8", "byte": "uint8"}
_LINE = "=" * 80
ANY = "*"
"""The md5 and type of a peer that accepts every type."""


@dataclass(frozen=True, slots=True)
class Ros1Type:
    """`name` as in `std_msgs/String`; `definition` is the text with those of its parts."""

    name: str
    md5: str
    definition: str = ""
    counts: bool = False
    """Whether messages start with a header, in which the publisher counts."""


@once
def message_type(struct: type[Any]) -> Ros1Type:
    """The type of a message. Raises `InterfaceMismatch`."""
    name = _short(struct._type_id_)
    first = struct._fields_[0] if struct._fields_ else ("", None)
    counts = first[0] == "header" and getattr(first[1], "_type_id_", "") == _HEADER
    definition = _definition(struct)
    parts = {name: definition.text}
    _collect(struct, parts)
    texts = [definition.text]
    texts += [f"{_LINE}\nMSG: {part}\n{text}" for part, text in parts.items() if part != name]
    return Ros1Type(name, _md5(struct), "".join(f"{text}\n" for text in texts if text), counts)


def service_type(request: type[Any], response: type[Any]) -> Ros1Type:
    """The type of a service; its md5 is that of both definitions. Raises `InterfaceMismatch`."""
    name = _short(request._type_id_).removesuffix("_Request")
    digest = md5(usedforsecurity=False)
    for part in (request, response):
        digest.update(_md5_text(part).encode())
    return Ros1Type(name, digest.hexdigest())


_HEADER = "std_msgs/msg/Header"


def _short(type_id: str) -> str:
    package, _, name = type_id.split("/")
    return f"{package}/{name}"


def _md5(struct: type[Any]) -> str:
    return md5(_md5_text(struct).encode(), usedforsecurity=False).hexdigest()


@once
def _md5_text(struct: type[Any]) -> str:
    """What the md5 covers: constants, then fields, with the md5 of the messages in them."""
    definition = _definition(struct)
    inner = [_element(type_) for _, type_ in struct._fields_]
    if len(definition.fields) > len(inner):  # `seq`
        inner.insert(0, None)
    lines = [f"{type_} {name}={value}" for type_, name, value in definition.constants]
    for (type_, name), struct_ in zip(definition.fields, inner, strict=True):
        lines.append(f"{_md5(struct_) if struct_ else type_} {name}")
    return "\n".join(lines)


def _element(type_: Type) -> Any:
    """The message in a field, alone or in an array; None for all others."""
    if isinstance(type_, Array | Sequence):
        return _element(type_.element)
    if not isinstance(type_, type):
        return None
    struct = type_._element_ if issubclass(type_, StructArrayBase) else type_
    is_message = issubclass(struct, StructBase) and struct._type_id_ not in _BUILT_IN  # type: ignore[attr-defined]
    return struct if is_message else None


def _collect(struct: type[Any], parts: dict[str, str]) -> None:
    for _, type_ in struct._fields_:
        inner = _element(type_)
        if inner is not None and _short(inner._type_id_) not in parts:
            parts[_short(inner._type_id_)] = _definition(inner).text
            _collect(inner, parts)


@once
def _definition(struct: type[Any]) -> Definition:
    """The definition of a message in ROS 1. Raises `InterfaceMismatch` if it differs."""
    from_struct = Definition((), tuple((_field(type_), name) for name, type_ in struct._fields_))
    if struct._type_id_ == _HEADER and all(name != "seq" for name, _ in struct._fields_):
        from_struct = Definition((), (("uint32", "seq"), *from_struct.fields))
    found = find_definition(struct._type_id_, struct._definition_)
    if found is None:
        return from_struct
    if difference := _difference(from_struct, found):
        raise InterfaceMismatch(
            f"ROS 1 defines {_short(struct._type_id_)} otherwise: {difference}. Use a message that"
            " is the same in both, or another middleware for this port"
        )
    return found


def _field(type_: Type) -> str:
    """The type of a field as in a `.msg` file of ROS 1."""
    if isinstance(type_, Array | Sequence):
        return f"{_field(type_.element)}[{type_.size or ''}]"
    if isinstance(type_, Primitive):
        return "string" if type_.is_text else _NAMES.get(type_, type_.name)
    if isinstance(type_, type) and issubclass(type_, StructArrayBase):
        return f"{_field(type_._element_)}[]"
    type_id: str = type_._type_id_  # type: ignore[union-attr]
    return _BUILT_IN.get(type_id) or _short(type_id)


def _difference(ours: Definition, theirs: Definition) -> str:
    """The first field that differs, empty if none does. Names are compared without case."""
    for index in range(max(len(ours.fields), len(theirs.fields))):
        if index >= len(theirs.fields):
            return f"it has no field `{ours.fields[index][1]}`"
        if index >= len(ours.fields):
            return f"it has a further field `{theirs.fields[index][1]}`"
        (our_type, our_name), (their_type, their_name) = ours.fields[index], theirs.fields[index]
        same_name = our_name.lower() == their_name.lower()
        if not same_name or _bits(our_type) != _bits(their_type):
            return (
                f"its field {index + 1} is `{their_type} {their_name}` instead of"
                f" `{our_type} {our_name}`"
            )
    return ""


@cache
def _bits(type_: str) -> str:
    """A type without the names that only differ in what the bytes mean."""
    element, bracket, rest = type_.partition("[")
    element = _SAME_BITS.get(element, element)
    return ("std_msgs/Header" if element == "Header" else element) + bracket + rest
