"""What the step-by-step readers of the wire formats share: the kinds of values.

In: bytes, a position, and a schema. Out: values, or `MalformedMessage` with path and offset. How a
number, a text or a count is written is up to the format.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.runtime.data.schema import (
    BOOL,
    Array,
    Dictionary,
    Enum,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct
from robocomp_dsl.runtime.errors import MalformedMessage


def check_length(type_: Array | Sequence, count: int, path: str, offset: int) -> None:
    """Raise `MalformedMessage` for a number of elements that the type does not have."""
    if type_.size and count != type_.size:
        raise MalformedMessage(f"{count} elements instead of {type_.size}", path, offset)
    if type_.bound and count > type_.bound:
        raise MalformedMessage(f"{count} elements, more than {type_.bound}", path, offset)


def check_text_length(type_: Primitive, size: int, path: str, offset: int) -> None:
    """Raise `MalformedMessage` for a text of more bytes than the type has."""
    if type_.bound and size > type_.bound:
        raise MalformedMessage(f"a text of {size} bytes, longer than {type_.bound}", path, offset)


def bools(array: Any, path: str, start: int) -> Any:
    """Bytes at the offset `start` as bools. Raises `MalformedMessage`."""
    wrong = array > 1
    if wrong.any():
        index = int(wrong.argmax())
        what = f"{array[index]} is no bool (0 or 1)"
        raise MalformedMessage(what, f"{path}[{index}]", start + index)
    return array.view(np.bool_)


class MessageReader:
    """The bytes and the read position; all offsets from the start of the message."""

    data: Any
    at: int

    def finish(self) -> None:
        """Raise for bytes after the end of the message."""
        if self.at != len(self.data):
            extra = len(self.data) - self.at
            raise MalformedMessage(f"{extra} bytes more than the message has", "", self.at)

    def value(self, type_: Type, path: str) -> Any:
        """One value of any type."""
        value: Any
        match type_:
            case Primitive():
                value = self.primitive(type_, path)
            case Array():
                value = self.array(type_, path)
            case Sequence():
                value = self.sequence(type_, path)
            case Dictionary():
                value = self.dictionary(type_, path)
            case _ if issubclass(type_, Enum):
                value = self.member(type_, path)
            case _ if issubclass(type_, Struct):
                value = self.record(type_, path)
            case _:
                value = self.struct_array(type_, path)
        return value

    def primitive(self, type_: Primitive, path: str) -> Any:
        """A number, a bool or a string."""
        if type_.is_text:
            return self.text(type_, path)
        if type_ is BOOL:
            number = self.number("B", path)
            if number > 1:
                raise MalformedMessage(f"{number} is no bool (0 or 1)", path, self.at - 1)
            return bool(number)
        return self.number(type_.code, path)

    def dictionary(self, type_: Dictionary, path: str) -> dict[Any, Any]:
        """Pairs; of duplicate keys the last one is used."""
        pairs = {}
        for index in range(self.count(path, 2)):
            key = self.value(type_.key, f"{path}[{index}].key")
            pairs[key] = self.value(type_.value, f"{path}[{index}].value")
        return pairs

    def number(self, code: str, path: str) -> Any:
        """One number."""
        raise NotImplementedError

    def count(self, path: str, size: int = 1) -> int:
        """A count of elements of at least `size` bytes."""
        raise NotImplementedError

    def text(self, type_: Primitive, path: str) -> str:
        """A text."""
        raise NotImplementedError

    def member(self, type_: type[Enum], path: str) -> Enum:
        """An enumerator."""
        raise NotImplementedError

    def record(self, type_: type[Struct], path: str) -> Struct:
        """A struct or exception."""
        raise NotImplementedError

    def sequence(self, type_: Sequence, path: str) -> list[Any]:
        """A list."""
        raise NotImplementedError

    def array(self, type_: Array, path: str) -> Any:
        """Numbers."""
        raise NotImplementedError

    def struct_array(self, type_: Any, path: str) -> Any:
        """Elements of fixed structs."""
        raise NotImplementedError
