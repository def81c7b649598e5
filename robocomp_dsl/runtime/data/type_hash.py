"""Canonical form and type hash of an interface. In: schema objects. Out: text, bytes.

Two components with the same canonical form can communicate.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import (
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component.interface import Interface, Operation


def digest(text: str) -> bytes:
    """The first 8 bytes of the SHA-256 of `text`."""
    from hashlib import sha256  # noqa: PLC0415 - loads OpenSSL, which types alone do not need

    return sha256(text.encode()).digest()[:8]


def interface_shape(interface: Interface) -> str:
    """One line per operation, in alphabetical order, because their order is irrelevant."""
    lines = sorted(_operation(operation) for operation in interface.operations)
    return "\n".join([f"interface {interface.name}", *lines])


def type_shape(type_: Type) -> str:
    """`struct{x:double,y:double}`, `sequence<int>` etc."""
    match type_:
        case Primitive():
            return type_.name
        case Array() | Sequence():
            return f"sequence<{type_shape(type_.element)}>"
        case Dictionary():
            return f"dictionary<{type_shape(type_.key)},{type_shape(type_.value)}>"
    if issubclass(type_, StructArray):
        return f"sequence<{type_shape(type_._element_)}>"
    if issubclass(type_, Struct):
        return f"struct{{{_fields(type_._fields_)}}}"
    return f"enum{{{_enumerators(type_)}}}"


def _fields(fields: Fields) -> str:
    return ",".join(f"{name}:{type_shape(type_)}" for name, type_ in fields)


def _enumerators(enum: type[Enum]) -> str:
    # Python appends an underscore to some names; other languages do not.
    return ",".join(f"{enumerator.name.rstrip('_')}={enumerator.value}" for enumerator in enum)


def _operation(operation: Operation) -> str:
    throws = ",".join(map(type_shape, operation.throws))
    return (
        f"{operation.pattern.value} {operation.name}({_fields(operation.inputs)})"
        f"->({_fields(operation.outputs)}) throws({throws})"
    )
