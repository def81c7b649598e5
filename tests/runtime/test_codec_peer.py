"""Another implementation of CDR (rosbags) gives the same bytes, for random types and values."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import given, settings
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec import codec
from tests.runtime.random_schemas import messages, struct_of

ROS_NAMES = {
    rt.BOOL: "bool",
    rt.BYTE: "uint8",
    rt.SHORT: "int16",
    rt.INT: "int32",
    rt.LONG: "int64",
    rt.FLOAT: "float32",
    rt.DOUBLE: "float64",
    rt.STRING: "string",
    rt.INT8: "int8",
    rt.OCTET: "uint8",  # rosbags reads `byte` as signed; ROS sends the same 8 bits
    rt.UINT16: "uint16",
    rt.UINT32: "uint32",
    rt.UINT64: "uint64",
}
LENGTH = re.compile(r"\[[^]]*\]$")
"""The brackets of a sequence: of any length, of at most or of exactly some elements."""


def brackets(type_: rt.Array | rt.Sequence) -> str:
    if type_.size:
        return f"[{type_.size}]"
    return f"[<={type_.bound}]" if type_.bound else "[]"


class Peer:
    """The types of one message, declared to the other implementation in its own language.

    It has no enums (int32 here), dictionaries (sequences of pairs) and sequences of sequences
    (a struct of one field between them, which leaves no trace on the wire).
    """

    def __init__(self, type_: type[rt.Struct]) -> None:
        self.store = get_typestore(Stores.EMPTY)
        self.definitions: dict[str, Any] = {}
        self.names: dict[type[Any], str] = {}
        self.name = self.declare(type_)
        self.store.register(self.definitions)

    def struct(self, fields: list[str]) -> str:
        name = f"peer/msg/T{len(self.definitions)}"
        text = "\n".join(f"{field} f{i}" for i, field in enumerate(fields))
        self.definitions.update(get_types_from_msg(text, name))
        return name

    def declare(self, type_: Any) -> str:
        """The name of the type of one value."""
        if isinstance(type_, rt.Primitive):
            bound = f"<={type_.bound}" if type_.bound else ""
            return ROS_NAMES[replace(type_, bound=0)] + bound
        if isinstance(type_, rt.Array):
            return f"{ROS_NAMES[type_.element]}{brackets(type_)}"
        if isinstance(type_, rt.Sequence):
            return self.sequence(self.declare(type_.element), brackets(type_))
        if isinstance(type_, rt.Dictionary):
            return self.struct([self.declare(type_.key), self.declare(type_.value)]) + "[]"
        if issubclass(type_, rt.StructArray):
            return self.sequence(self.declare(type_._element_))
        if issubclass(type_, rt.Enum):
            return "int32"
        if type_ not in self.names:
            self.names[type_] = self.struct([self.declare(t) for _, t in type_._fields_])
        return self.names[type_]

    def sequence(self, element: str, length: str = "[]") -> str:
        return (self.struct([element]) if element.endswith("]") else element) + length

    def value(self, name: str, type_: Any, value: Any) -> Any:
        """Our value as an object of the peer; `name` is that of the peer's type."""
        if isinstance(type_, rt.Primitive | rt.Array):
            return value
        if isinstance(type_, rt.Dictionary):
            pair = LENGTH.sub("", name)
            key, item = (self.field(pair, i) for i in (0, 1))
            return [
                self.store.types[pair](
                    self.value(key, type_.key, k), self.value(item, type_.value, v)
                )
                for k, v in value.items()
            ]
        if isinstance(type_, rt.Sequence):
            items = self.items(name, type_.element, value)
            is_enum = isinstance(type_.element, type) and issubclass(type_.element, rt.Enum)
            return np.array(items, np.int32) if is_enum else items
        if issubclass(type_, rt.StructArray):
            return self.items(name, type_._element_, value)
        if issubclass(type_, rt.Enum):
            return int(value)
        fields = zip(value._names_, type_._fields_, strict=True)
        return self.store.types[name](
            *(
                self.value(self.field(name, i), inner, getattr(value, attribute))
                for i, (attribute, (_, inner)) in enumerate(fields)
            )
        )

    def items(self, name: str, element: Any, value: Any) -> list[Any]:
        inner = LENGTH.sub("", name)
        wrapped = isinstance(element, rt.Array | rt.Sequence | rt.Dictionary) or (
            isinstance(element, type) and issubclass(element, rt.StructArray)
        )
        if not wrapped:
            return [self.value(inner, element, item) for item in value]
        wrapper = self.store.types[inner]
        return [wrapper(self.value(self.field(inner, 0), element, item)) for item in value]

    def field(self, name: str, index: int) -> str:
        """The name of the type of a field of a struct of the peer."""
        kind, detail = self.definitions[name][1][index][1]
        if kind.name in ("SEQUENCE", "ARRAY"):
            return str(detail[0][1] if detail[0][0].name == "NAME" else detail[0][1][0]) + "[]"
        return str(detail if kind.name == "NAME" else detail[0])

    def encode(self, message: rt.Struct, *, little: bool = True) -> bytes:
        value = self.value(self.name, type(message), message)
        return bytes(self.store.serialize_cdr(value, self.name, little_endian=little))

    def reencode(self, data: bytes) -> bytes:
        """The bytes again, after the peer has decoded them."""
        value = self.store.deserialize_cdr(data, self.name)
        return bytes(self.store.serialize_cdr(value, self.name))


# The peer compiles its own code for every schema, so no deadline.
@settings(max_examples=150)
@given(messages())
def test_codec_matches_rosbags_in_both_directions(message: rt.Struct) -> None:
    peer = Peer(type(message))
    ours, theirs = codec.encode(message), peer.encode(message)
    assert ours == theirs
    assert codec.encode(codec.decode(type(message), theirs)) == theirs
    assert peer.reencode(ours) == ours
    big = peer.encode(message, little=False)
    assert big[:2] == b"\0\0"
    assert codec.encode(codec.decode(type(message), big)) == ours


def test_codec_comparison_detects_different_types() -> None:
    ours, theirs = struct_of([rt.INT, rt.DOUBLE]), struct_of([rt.DOUBLE, rt.INT])
    assert codec.encode(ours(1, 2.0)) != Peer(theirs).encode(theirs(2.0, 1))
