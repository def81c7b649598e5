"""The IDSL types in the runtime: schema objects for codecs and type hashes.

In: declarations and annotations of generated code. Out: immutable schema objects; structs,
exceptions, enums and struct arrays are described by their classes themselves.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, TypeAlias, get_args, get_origin

import numpy as np


@dataclass(frozen=True, slots=True)
class Primitive:
    """A built-in type. `code` is its letter in `struct` formats, empty for a string.

    `size` in bytes is also its alignment on the wire (OMG CDR, section 15.3.1.1 of CORBA 3.0).
    `bound` is the largest length of a string in bytes of UTF-8; 0: unlimited.
    """

    name: str
    code: str
    size: int
    bound: int = 0

    @property
    def is_text(self) -> bool:
        """Whether it is a string."""
        return not self.code

    @property
    def dtype(self) -> np.dtype[Any]:
        """The numpy dtype of its arrays, in wire order."""
        return np.dtype(f"<{self.code}" if self.size > 1 else self.code)


BOOL = Primitive("bool", "?", 1)
BYTE = Primitive("byte", "B", 1)  # unsigned, as in ROS and YARP
SHORT = Primitive("short", "h", 2)
INT = Primitive("int", "i", 4)
LONG = Primitive("long", "q", 8)
FLOAT = Primitive("float", "f", 4)
DOUBLE = Primitive("double", "d", 8)
STRING = Primitive("string", "", 4)  # its length prefix

# Only imported ROS types have these; ROS's uint8, int16, int32, int64 are BYTE, SHORT, INT, LONG.
INT8 = Primitive("int8", "b", 1)
OCTET = Primitive("octet", "B", 1)  # `byte` in ROS, whose type description tells it from uint8
UINT16 = Primitive("uint16", "H", 2)
UINT32 = Primitive("uint32", "I", 4)
UINT64 = Primitive("uint64", "Q", 8)

PRIMITIVES = {
    primitive.name: primitive
    for primitive in (
        *(BOOL, BYTE, SHORT, INT, LONG, FLOAT, DOUBLE, STRING),
        *(INT8, OCTET, UINT16, UINT32, UINT64),
    )
}
"""All built-in types by name."""


class Enum(enum.IntEnum):
    """Base of the enumerations of an IDSL file; 32 bits on the wire."""


class StructBase:
    """What the schema knows of a struct or exception class; `Struct` is its only subclass."""

    __slots__ = ()
    _fields_: ClassVar[Fields]  # (name on the wire, type)
    _names_: ClassVar[tuple[str, ...]]  # the attributes, in the same order
    _units_: ClassVar[Mapping[str, str]]  # name on the wire to unit


class StructArrayBase:
    """What the schema knows of an array of structs; `StructArray` is its only subclass."""

    __slots__ = ()
    _element_: ClassVar[type[Any]]


@dataclass(frozen=True, slots=True)
class Array:
    """A sequence of numbers or bools; in Python a one-dimensional numpy array.

    `size` is the number of elements of a fixed array, which has no count on the wire; `bound` the
    largest number of a bounded one. 0: neither.
    """

    element: Primitive
    size: int = 0
    bound: int = 0

    def __post_init__(self) -> None:
        if not isinstance(self.element, Primitive) or self.element.is_text:
            raise TypeError(f"an Array is of numbers or bools, not of {self.element!r}")


@dataclass(frozen=True, slots=True)
class Sequence:
    """A sequence of any other type; in Python a list. `size` and `bound` as in `Array`."""

    element: Type
    size: int = 0
    bound: int = 0

    def __post_init__(self) -> None:
        if isinstance(self.element, Primitive) and not self.element.is_text:
            raise TypeError(f"a sequence of {self.element.name} is an Array")


@dataclass(frozen=True, slots=True)
class Dictionary:
    """Keys and values; in Python a dict, on the wire a sequence of (key, value) structs."""

    key: Type
    value: Type

    def __post_init__(self) -> None:
        if isinstance(self.key, Array | Sequence | Dictionary):
            raise TypeError("the key of a dictionary is a primitive, an enum or a struct")


Type: TypeAlias = (
    Primitive | Array | Sequence | Dictionary | type[Enum | StructBase | StructArrayBase]
)
Fields: TypeAlias = tuple[tuple[str, Type], ...]

Declared: TypeAlias = "Mapping[str, object] | Iterable[tuple[str, object]]"
"""Fields in generated code: names and annotations."""

_OBJECTS = (Primitive, Array, Sequence, Dictionary)


@dataclass(frozen=True, slots=True)
class Length:
    """Annotates a fixed array: `Annotated[rt.Float64Array, rt.Length(36)]`."""

    size: int

    def applied_to(self, type_: Type) -> Type:
        """`type_` with this number of elements. Raises `TypeError` if it is no sequence."""
        if not isinstance(type_, Array | Sequence) or self.size < 1:
            raise TypeError(f"{type_!r} cannot have the length {self.size}")
        return replace(type_, size=self.size)


@dataclass(frozen=True, slots=True)
class MaxLength:
    """Annotates a bounded sequence or string: `Annotated[rt.String, rt.MaxLength(10)]`."""

    bound: int

    def applied_to(self, type_: Type) -> Type:
        """`type_` with at most this many elements. Raises `TypeError` for other types."""
        is_string = isinstance(type_, Primitive) and type_.is_text
        if not (is_string or isinstance(type_, Array | Sequence)) or self.bound < 1:
            raise TypeError(f"{type_!r} cannot have the largest length {self.bound}")
        return replace(type_, bound=self.bound)  # type: ignore[type-var]


def schema_of(annotation: Any) -> Type:
    """The type of an annotation in generated code; a schema object is returned unchanged.

    `Annotated[float, FLOAT]` is FLOAT, `list[X]` a sequence, `dict[K, V]` a dictionary. Raises
    `TypeError` for any type that IDSL lacks.
    """
    if metadata := getattr(annotation, "__metadata__", None):
        if isinstance(metadata[-1], Length | MaxLength):
            return _limited(annotation, metadata)
        annotation = metadata[0]
    if isinstance(annotation, type(list[int])):
        origin, inner = (
            get_origin(annotation),
            [schema_of(argument) for argument in get_args(annotation)],
        )
        if origin is list:
            return Sequence(inner[0])
        if origin is dict:
            return Dictionary(*inner)
    elif isinstance(annotation, _OBJECTS) or _is_declared(annotation):
        schema: Type = annotation
        return schema
    raise TypeError(f"{annotation!r} is no type of IDSL; fields are annotated as in `rt.Int`")


def _limited(annotation: Any, metadata: tuple[Any, ...]) -> Type:
    """The type of an annotation with `Length` or `MaxLength`."""
    is_named = not isinstance(metadata[0], Length | MaxLength)
    schema = schema_of(metadata[0] if is_named else annotation.__origin__)
    for limit in metadata[1:] if is_named else metadata:
        schema = limit.applied_to(schema)
    return schema


def _is_declared(cls: Any) -> bool:
    """Whether it is an enum, a struct or a struct array, whose class has the schema."""
    return isinstance(cls, type) and issubclass(cls, Enum | StructBase | StructArrayBase)


def fields_of(declared: Declared) -> Fields:
    """The fields with their types."""
    pairs = declared.items() if isinstance(declared, Mapping) else declared
    return tuple((name, schema_of(type_)) for name, type_ in pairs)
