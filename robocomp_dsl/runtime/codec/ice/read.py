"""Reads a message of Ice step by step. In: bytes and a schema. Out: values, or `MalformedMessage`.

The fallback of the generated decoders: it locates invalid fields by path and byte offset. It is a
complete decoder; tests compare the generated decoders with it.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.ice import rows, wire
from robocomp_dsl.runtime.codec.message_reader import (
    MessageReader,
    bools,
    check_length,
    check_text_length,
)
from robocomp_dsl.runtime.codec.struct_arrays import bad_element
from robocomp_dsl.runtime.data.declared_error import DeclaredError
from robocomp_dsl.runtime.data.layout import row_layout
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


def read(fields: Fields, form: str, order: tuple[int, ...], message: bytes) -> Any:
    """The values of `fields`; `form` is the form of the result: `none`, `one` or `tuple`."""
    reader = Reader(message)
    values = [None] * len(fields)
    for index in order:
        name, type_ = fields[index]
        values[index] = reader.value(type_, (name or "result") if form == "tuple" else name)
    reader.finish()
    if form == "tuple":
        return tuple(values)
    return values[0] if values else None


class Reader(MessageReader):
    """The bytes of an encapsulation and the read position."""

    def __init__(self, message: bytes) -> None:
        header = wire.HEADER
        if len(message) < header.size:
            raise MalformedMessage(f"{len(message)} bytes, shorter than the header of 6")
        size, version = header.unpack_from(message)
        if size != len(message):
            raise MalformedMessage(f"{size} bytes announced, {len(message)} arrived")
        if version != wire.VERSION:
            name = f"{message[4]}.{message[5]}"
            hint = "; run the peer without --Ice.Default.EncodingVersion" if name == "1.0" else ""
            raise MalformedMessage(f"encoding {name} of Ice, only 1.1 is supported{hint}", "", 4)
        self.data = message
        self.at = header.size

    def take(self, size: int, path: str) -> int:
        """Skip `size` bytes; returns the offset where they start."""
        start = self.at
        left = len(self.data) - start
        if size > left:
            raise MalformedMessage(f"{size} bytes expected, {left} left", path, start)
        self.at += size
        return start

    def number(self, code: str, path: str) -> Any:
        """One number."""
        form = struct.Struct(f"<{code}")
        return form.unpack_from(self.data, self.take(form.size, path))[0]

    def size(self, path: str) -> int:
        """A size."""
        number: int = self.number("B", path)
        if number > wire.MAX_BYTE:
            number = self.number("i", path)
            if number < 0:
                raise MalformedMessage(f"{number} is no size", path, self.at - 4)
        return number

    def count(self, path: str, size: int = 1) -> int:
        """A number of elements of at least `size` bytes, limited by the remaining bytes."""
        start = self.at
        count = self.size(path)
        left = len(self.data) - self.at
        if count * size > left:
            raise MalformedMessage(f"{count} elements claimed, {left} bytes left", path, start)
        return count

    def text(self, type_: Primitive, path: str) -> str:
        """Size and UTF-8."""
        before = self.at
        size = self.count(path)
        check_text_length(type_, size, path, before)
        start = self.take(size, path)
        try:
            return str(self.data[start : self.at], "utf-8")
        except UnicodeDecodeError as error:
            raise MalformedMessage("the text is not UTF-8", path, start + error.start) from None

    def member(self, type_: type[Enum], path: str) -> Enum:
        """An enumerator."""
        start = self.at
        number = self.size(path)
        try:
            return type_(number)
        except ValueError:
            what = f"{number} is no value of {type_.__name__}"
            raise MalformedMessage(what, path, start) from None

    def record(self, type_: type[Struct], path: str) -> Struct:
        """A struct or exception."""
        value = type_.__new__(type_)
        for attribute, (name, inner) in zip(type_._names_, type_._fields_, strict=True):
            setattr(value, attribute, self.value(inner, f"{path}.{name}" if path else name))
        if not type_._fields_ and not issubclass(type_, DeclaredError):
            self.take(1, path)
        return value

    def sequence(self, type_: Sequence, path: str) -> list[Any]:
        """A list; every element has at least one byte."""
        start = self.at
        count = self.count(path)
        check_length(type_, count, path, start)
        return [self.value(type_.element, f"{path}[{i}]") for i in range(count)]

    def array(self, type_: Array, path: str) -> Any:
        """Numbers: a view of the message, or a copy if its memory is not aligned."""
        primitive, before = type_.element, self.at
        count = self.count(path, primitive.size)
        check_length(type_, count, path, before)
        dtype = np.dtype(np.uint8) if primitive is BOOL else primitive.dtype
        start = self.take(count * primitive.size, path)
        array = np.ndarray(count, dtype, self.data, start)
        return bools(array, path, start) if primitive is BOOL else rows.aligned(array)

    def struct_array(self, type_: Any, path: str) -> Any:
        """Elements of fixed structs."""
        packed = rows.packed_rows(type_._element_)
        if packed is None:
            return type_(self.sequence(Sequence(type_._element_), path))
        count = self.count(path, packed.dtype.itemsize)
        start = self.take(count * packed.dtype.itemsize, path)
        array = rows.unpack(packed, self.data, start, count)
        wrong = bad_element(row_layout(type_._element_), array)
        if wrong is not None:  # reading it again locates the error
            self.at = start + wrong * packed.dtype.itemsize
            self.record(type_._element_, f"{path}[{wrong}]")
        return type_._over(array)
