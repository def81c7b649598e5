"""Data types of IDSL, resolved: a field refers to its type object.

The checks reject recursive types, so a type is always a finite tree.
"""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.record import Record, ValueRecord
from robocomp_dsl.source import Span


class Primitive(ValueRecord):
    """A built-in type; `bits` is its width on the wire, 0 for a string.

    `bound` is the largest length of a string in bytes of UTF-8; 0: unlimited.
    """

    name: str
    bits: int
    bound: int = 0

    @property
    def is_text(self) -> bool:
        """Whether it is a string."""
        return not self.bits

    @property
    def is_unsigned(self) -> bool:
        """Whether it is an integer without negative values."""
        return self in (BYTE, OCTET, UINT16, UINT32, UINT64)


BOOL = Primitive("bool", 8)
BYTE = Primitive("byte", 8)
SHORT = Primitive("short", 16)
INT = Primitive("int", 32)
LONG = Primitive("long", 64)
FLOAT = Primitive("float", 32)
DOUBLE = Primitive("double", 64)
STRING = Primitive("string", 0)
UINT16 = Primitive("unsigned short", 16)
UINT32 = Primitive("unsigned int", 32)
UINT64 = Primitive("unsigned long", 64)

PRIMITIVES = {
    t.name: t for t in (BOOL, BYTE, SHORT, INT, LONG, UINT16, UINT32, UINT64, FLOAT, DOUBLE, STRING)
}
"""The built-in types of IDSL by name."""

INT8 = Primitive("int8", 8)
OCTET = Primitive("octet", 8)
ROS_PRIMITIVES = {
    "bool": BOOL,
    "byte": OCTET,
    "char": BYTE,
    "uint8": BYTE,
    "int8": INT8,
    "int16": SHORT,
    "uint16": UINT16,
    "int32": INT,
    "uint32": UINT32,
    "int64": LONG,
    "uint64": UINT64,
    "float32": FLOAT,
    "float64": DOUBLE,
    "string": STRING,
}
"""The built-in types of ROS by name."""

NUMBERS = frozenset((BYTE, SHORT, INT, LONG, FLOAT, DOUBLE, INT8, OCTET, UINT16, UINT32, UINT64))

Literal: TypeAlias = bool | int | float | str


class Declaration(Record):
    """A named declaration of an IDSL module; `span` covers its name."""

    module: str
    name: str
    span: Span
    doc: str

    @property
    def qualified(self) -> str:
        """`Module::Name`, as users write it."""
        return f"{self.module}::{self.name}"

    @property
    def type_id(self) -> str:
        """The name that running programs know it by."""
        return self.qualified


class Field(Record):
    """A field of a struct or exception. An enum default is the name of the enumerator.

    `items` is the default of an array in a ROS definition.
    """

    name: str
    type: Type
    span: Span
    default: Literal | None = None
    unit: str = ""
    doc: str = ""
    items: tuple[Literal, ...] = ()


class Constant(Record):
    """A named value of a ROS message."""

    name: str
    type: Primitive
    value: Literal
    span: Span
    doc: str = ""


class Struct(Declaration):
    """A record. `ros_name` is `sensor_msgs/msg/Image` if it was imported from ROS.

    `definition` is the text of a ROS definition whose md5 does not follow from the fields: it has
    constants, or types that share one type of IDSL.
    """

    fields: tuple[Field, ...]
    constants: tuple[Constant, ...] = ()
    ros_name: str = ""
    definition: str = ""

    @property
    def type_id(self) -> str:
        """The ROS name, or `Module::Name`."""
        return self.ros_name or self.qualified


class ExceptionType(Declaration):
    """A declared failure; it carries data as a struct does."""

    fields: tuple[Field, ...]


class Enumerator(Record):
    """One value of an enumeration."""

    name: str
    value: int
    span: Span
    doc: str = ""


class Enum(Declaration):
    """An enumeration, 32 bits on the wire."""

    enumerators: tuple[Enumerator, ...]


class Sequence(Declaration):
    """`sequence<element> name`, `sequence<element, bound> name`, or the array of a field.

    The latter has no declaration: `is_anonymous`, and its name is that of its type, `double[36]`.
    `size` is the number of elements of a fixed array, `bound` the largest number; 0: any.
    """

    element: Type
    size: int = 0
    bound: int = 0
    is_anonymous: bool = False

    @property
    def qualified(self) -> str:
        """`Module::Name`, or the type of an anonymous one."""
        return self.name if self.is_anonymous else f"{self.module}::{self.name}"


class Dictionary(Declaration):
    """`dictionary<key, value> name`; on the wire a sequence of pairs."""

    key: Type
    value: Type


class Alias(Declaration):
    """Another name of a type, from a `typedef` of Thrift; fields have the type itself."""

    target: Type


Type: TypeAlias = Primitive | Struct | Enum | Sequence | Dictionary


def is_fixed(type_: Type) -> bool:
    """Whether every value has the same layout: numbers, bools, enums and structs of them.

    A sequence of such structs becomes one numpy structured array.
    """
    match type_:
        case Primitive():
            return not type_.is_text
        case Enum():
            return True
        case Struct():
            return bool(type_.fields) and all(is_fixed(f.type) for f in type_.fields)
    return False
