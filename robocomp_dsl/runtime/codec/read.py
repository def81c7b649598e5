"""Reads a message step by step. In: bytes and a schema. Out: values, or `MalformedMessage`.

The fallback of the generated decoders: it locates invalid fields by path and byte offset, and reads
big-endian messages and padding declared in the header options (DDS-XTypes 1.3, section 7.6.3.1.2).
It is a complete decoder; tests compare the generated decoders with it.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.message_reader import (
    MessageReader,
    bools,
    check_length,
    check_text_length,
)
from robocomp_dsl.runtime.codec.struct_arrays import bad_element, begin, unpack
from robocomp_dsl.runtime.codec.wire_profile import (
    CDR,
    MAX_EMPTY_ELEMENTS,
    SEQ_BYTES,
    WireProfile,
)
from robocomp_dsl.runtime.data.layout import packed_layout, padding, row_layout
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    Array,
    Enum,
    Fields,
    Primitive,
    Sequence,
)
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import MalformedMessage

_BIG, _LITTLE = b"\0\0", b"\0\1"


def read(fields: Fields, form: str, message: Any, wire: WireProfile = CDR) -> Any:
    """The values of `fields`; `form` is the form of the result: `none`, `one` or `tuple`."""
    reader = _Reader(message, wire)
    several = form == "tuple"
    values = tuple(
        reader.value(type_, (name or "result") if several else name) for name, type_ in fields
    )
    if not fields and wire.pads_empty:
        reader.take(1, "")
    reader.finish()
    if several:
        return values
    return values[0] if values else None


def read_number(message: Any, limit: int, what: str) -> int:
    """The int at the start of a message, from 0 to below `limit`."""
    reader = _Reader(memoryview(message), CDR)
    number: int = reader.number("i", "")
    if not 0 <= number < limit:
        raise MalformedMessage(f"{number} is no {what} (below {limit})", "", 4)
    return number


class _Reader(MessageReader):
    """The bytes and the read position; all offsets from the start of the message."""

    def __init__(self, message: Any, wire: WireProfile) -> None:
        self.wire = wire
        self.big = False
        self.data = message
        self.at = wire.start
        if wire.header is not None:
            self._open(message)

    def _open(self, message: Any) -> None:
        """Read the header of CDR."""
        if len(message) < 4:
            raise MalformedMessage(f"{len(message)} bytes, shorter than the header of 4")
        kind, options = bytes(message[:2]), message[3] & 3
        if kind not in (_BIG, _LITTLE):
            raise MalformedMessage(f"encoding {kind.hex()} is not CDR (0000 or 0001)")
        if len(message) - options < 4:
            raise MalformedMessage(f"{options} bytes of padding announced, there are fewer", "", 3)
        # Arrays are views of the message and must not be writable.
        self.data = message[: len(message) - options] if options else message
        self.big = kind == _BIG

    def take(self, size: int, path: str, alignment: int = 1) -> int:
        """Skip padding and `size` bytes; returns the offset where the bytes start."""
        start = self.at + padding(self.at - self.wire.start, self.wire.alignment(alignment))
        if start + size > len(self.data):
            start = min(start, len(self.data))
            left = len(self.data) - start
            raise MalformedMessage(f"{size} bytes expected, {left} left", path, start)
        self.at = start + size
        return start

    def number(self, code: str, path: str) -> Any:
        """One number."""
        form = struct.Struct((">" if self.big else "<") + code)
        return form.unpack_from(self.data, self.take(form.size, path, form.size))[0]

    def count(self, path: str, size: int = 1) -> int:
        """A count of elements of at least `size` bytes, limited by the remaining bytes."""
        count: int = self.number("I", path)
        left = len(self.data) - self.at
        if count * size > left:
            raise MalformedMessage(
                f"{count} elements claimed, {left} bytes left", path, self.at - 4
            )
        return count

    def length(self, type_: Array | Sequence, path: str, size: int) -> int:
        """The number of elements of a sequence; that of a fixed array is not in the message."""
        if type_.size:
            return type_.size
        count = self.count(path, size)
        check_length(type_, count, path, self.at - 4)
        return count

    def text(self, type_: Primitive, path: str) -> str:
        """Length, UTF-8, NUL."""
        nul = int(self.wire.terminated)
        length = self.number("I", path)
        check_text_length(type_, length - nul, path, self.at - 4)
        start = self.take(length, path)
        if not length:
            return ""
        if nul and self.data[self.at - 1]:
            raise MalformedMessage("the text does not end with NUL", path, self.at - 1)
        try:
            return str(self.data[start : self.at - nul], "utf-8")
        except UnicodeDecodeError as error:
            raise MalformedMessage("the text is not UTF-8", path, start + error.start) from None

    def member(self, type_: type[Enum], path: str) -> Enum:
        """An enumerator."""
        number = self.number("i", path)
        try:
            return type_(number)
        except ValueError:
            raise MalformedMessage(
                f"{number} is no value of {type_.__name__}", path, self.at - 4
            ) from None

    def record(self, type_: type[Struct], path: str) -> Struct:
        """A struct or exception."""
        value = type_.__new__(type_)
        if self.wire.inserts_seq(type_):
            self.take(SEQ_BYTES, f"{path}.seq" if path else "seq")
        for attribute, (name, inner) in zip(type_._names_, type_._fields_, strict=True):
            setattr(value, attribute, self.value(inner, f"{path}.{name}" if path else name))
        if not type_._fields_ and self.wire.pads_empty:
            self.take(1, path)
        return value

    def sequence(self, type_: Sequence, path: str) -> list[Any]:
        """A list; in CDR every element has at least one byte."""
        count = self.length(type_, path, 1 if self.wire.pads_empty else 0)
        if count > len(self.data) + MAX_EMPTY_ELEMENTS:
            raise MalformedMessage(f"{count} elements claimed", path, self.at - 4)
        return [self.value(type_.element, f"{path}[{i}]") for i in range(count)]

    def array(self, type_: Array, path: str) -> Any:
        """Numbers: a view of the message, or a copy if the byte order differs."""
        primitive = type_.element
        count = self.length(type_, path, primitive.size)
        dtype = np.dtype(np.uint8) if primitive is BOOL else primitive.dtype
        start = self.take(count * primitive.size, path, primitive.size) if count else self.at
        array = np.ndarray(count, self.ordered(dtype), self.data, start)
        if primitive is BOOL:
            return bools(array, path, start)
        return self.native(array, dtype)

    def ordered(self, dtype: np.dtype[Any]) -> np.dtype[Any]:
        """The type in the byte order of the message."""
        return dtype.newbyteorder(">") if self.big else dtype

    def native(self, array: Any, dtype: np.dtype[Any]) -> Any:
        """The array in native byte order; read-only like all received arrays."""
        if self.big and dtype.itemsize > 1:
            array = array.astype(dtype)
            array.flags.writeable = False
        return array

    def struct_array(self, type_: Any, path: str) -> Any:
        """Elements of fixed structs."""
        layout = row_layout(type_._element_)
        count = self.count(path, sum(leaf.primitive.size for leaf in layout.leaves))
        if not self.wire.aligned:
            return self.packed_array(type_, count, path)
        at, dtype = self.at, self.ordered(layout.dtype)
        try:
            array, self.at = unpack(layout, self.data, at, count, dtype)
        except ValueError as error:
            raise MalformedMessage(str(error), path, at) from None
        wrong = bad_element(layout, array)
        if wrong is not None:  # reading it again locates the error
            self.at = begin(layout, at, wrong)
            self.record(type_._element_, f"{path}[{wrong}]")
        return type_._over(self.native(array, layout.dtype))

    def packed_array(self, type_: Any, count: int, path: str) -> Any:
        """Elements of fixed structs without padding."""
        layout, packed = row_layout(type_._element_), packed_layout(type_._element_)
        at = self.take(count * packed.stride, path)
        array: Any = np.ndarray(count, packed.dtype, self.data, at)
        wrong = bad_element(packed, array)
        if wrong is not None:  # reading it again locates the error
            self.at = at + wrong * packed.stride
            self.record(type_._element_, f"{path}[{wrong}]")
        if packed.dtype != layout.dtype:
            array = array.astype(layout.dtype)
            array.flags.writeable = False
        return type_._over(array)
