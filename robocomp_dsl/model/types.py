"""Data types of IDSL, resolved: a field refers to its type object.

The checks reject recursive types, so a type is always a finite tree.
"""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.record import Record, ValueRecord
from robocomp_dsl.source import Span


class Primitive(ValueRecord):
    """A built-in type; `bits` is its width on the wire, 0 for a string."""

    name: str
    bits: int


BOOL = Primitive("bool", 8)
BYTE = Primitive("byte", 8)
SHORT = Primitive("short", 16)
INT = Primitive("int", 32)
LONG = Primitive("long", 64)
FLOAT = Primitive("float", 32)
DOUBLE = Primitive("double", 64)
STRING = Primitive("string", 0)

PRIMITIVES = {t.name: t for t in (BOOL, BYTE, SHORT, INT, LONG, FLOAT, DOUBLE, STRING)}
NUMBERS = (BYTE, SHORT, INT, LONG, FLOAT, DOUBLE)

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


class Field(Record):
    """A field of a struct or exception. An enum default is the name of the enumerator."""

    name: str
    type: Type
    span: Span
    default: Literal | None = None
    unit: str = ""
    doc: str = ""


class Struct(Declaration):
    """A record."""

    fields: tuple[Field, ...]


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
    """`sequence<element> name`."""

    element: Type


class Dictionary(Declaration):
    """`dictionary<key, value> name`; on the wire a sequence of pairs."""

    key: Type
    value: Type


Type: TypeAlias = Primitive | Struct | Enum | Sequence | Dictionary


def is_fixed(type_: Type) -> bool:
    """Whether every value has the same layout: numbers, bools, enums and structs of them.

    A sequence of such structs becomes one numpy structured array.
    """
    match type_:
        case Primitive():
            return type_ is not STRING
        case Enum():
            return True
        case Struct():
            return bool(type_.fields) and all(is_fixed(f.type) for f in type_.fields)
    return False
