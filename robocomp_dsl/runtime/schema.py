"""The types of IDSL as the runtime sees them: what the codec encodes and the shape hash covers.

In: what generated code declares. Out: immutable schema objects; structs, exceptions, enums and
struct arrays are described by their classes themselves.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from robocomp_dsl.runtime.arrays import StructArray
    from robocomp_dsl.runtime.record import Record


@dataclass(frozen=True, slots=True)
class Primitive:
    """A built-in type. `code` is its letter in `struct` formats, empty for a string.

    `size` in bytes is also its alignment on the wire (OMG CDR, section 15.3.1.1 of CORBA 3.0).
    """

    name: str
    code: str
    size: int

    @property
    def dtype(self) -> np.dtype[Any]:
        """The numpy type of an array of it, in wire order."""
        return np.dtype(f"<{self.code}" if self.size > 1 else self.code)


BOOL = Primitive("bool", "?", 1)
BYTE = Primitive("byte", "B", 1)  # unsigned, as ROS and YARP have it
SHORT = Primitive("short", "h", 2)
INT = Primitive("int", "i", 4)
LONG = Primitive("long", "q", 8)
FLOAT = Primitive("float", "f", 4)
DOUBLE = Primitive("double", "d", 8)
STRING = Primitive("string", "", 4)  # it begins with its length


class Enum(enum.IntEnum):
    """Base of the enumerations that an IDSL file declares; 32 bits on the wire."""


@dataclass(frozen=True, slots=True)
class Array:
    """A sequence of numbers or bools; one-dimensional numpy array in Python."""

    element: Primitive

    def __post_init__(self) -> None:
        if not isinstance(self.element, Primitive) or self.element is STRING:
            raise TypeError(f"an Array is of numbers or bools, not of {self.element!r}")


@dataclass(frozen=True, slots=True)
class Sequence:
    """A sequence of anything else; a list in Python."""

    element: Type

    def __post_init__(self) -> None:
        if isinstance(self.element, Primitive) and self.element is not STRING:
            raise TypeError(f"a sequence of {self.element.name} is an Array")


@dataclass(frozen=True, slots=True)
class Dictionary:
    """Keys and values; a dict in Python, a sequence of (key, value) structs on the wire."""

    key: Type
    value: Type

    def __post_init__(self) -> None:
        if isinstance(self.key, Array | Sequence | Dictionary):
            raise TypeError("the key of a dictionary is a primitive, an enum or a struct")


Type: TypeAlias = (
    "Primitive | Array | Sequence | Dictionary | type[Enum | Record | StructArray[Any]]"
)
Fields: TypeAlias = tuple[tuple[str, Type], ...]
