"""Canonical form and type hash of an interface. In: schema objects. Out: text, bytes.

Two components can call each other's operations that have the same canonical form, its shape.
`shape_difference` reads shapes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from robocomp_dsl.runtime.data.schema import (
    Array,
    Dictionary,
    Enum,
    Fields,
    Primitive,
    Sequence,
    StructArrayBase,
    StructBase,
    Type,
)

NO_UNITS: Mapping[str, str] = {}


def interface_hash(name: str, operations: Iterable[str]) -> bytes:
    """The first 8 bytes of the SHA-256 of the shape of an interface.

    `operations` are their shapes, in any order: the order in the file has no meaning.
    """
    from hashlib import sha256  # noqa: PLC0415 - loads OpenSSL, which types alone do not need

    text = "\n".join([f"interface {name}", *sorted(operations)])
    return sha256(text.encode()).digest()[:8]


def operation_shape(
    pattern: str,
    name: str,
    inputs: Fields,
    outputs: Fields,
    throws: Iterable[Type],
    units: Mapping[str, str] = NO_UNITS,
) -> str:
    """One line: pattern, name, parameters with types and units, exceptions."""
    exceptions = ",".join(map(type_shape, throws))
    parameters = f"({_fields(inputs, units)})->({_fields(outputs, units)})"
    return f"{pattern} {name}{parameters} throws({exceptions})"


def type_shape(type_: Type) -> str:
    """`struct{x:double[mm],y:double[mm]}`, `sequence<int>` etc."""
    match type_:
        case Primitive():
            return f"{type_.name}<{type_.bound}>" if type_.bound else type_.name
        case Array() | Sequence():
            return sequence_shape(type_, type_shape(type_.element))
        case Dictionary():
            return f"dictionary<{type_shape(type_.key)},{type_shape(type_.value)}>"
    if issubclass(type_, StructArrayBase):
        return f"sequence<{type_shape(type_._element_)}>"
    if issubclass(type_, StructBase):
        return f"struct{{{_fields(type_._fields_, type_._units_)}}}"
    return f"enum{{{_enumerators(type_)}}}"


def sequence_shape(type_: Array | Sequence, element: str) -> str:
    """`sequence<int>`, `sequence<int,5>` with at most 5 elements, `array<int,5>` with exactly 5."""
    if type_.size:
        return f"array<{element},{type_.size}>"
    return f"sequence<{element},{type_.bound}>" if type_.bound else f"sequence<{element}>"


def _fields(fields: Fields, units: Mapping[str, str]) -> str:
    if not units:
        return ",".join(f"{name}:{type_shape(type_)}" for name, type_ in fields)
    texts = (f"{name}:{type_shape(type_)}{_unit(units.get(name))}" for name, type_ in fields)
    return ",".join(texts)


def _unit(unit: str | None) -> str:
    return f"[{unit}]" if unit else ""


def _enumerators(enum: type[Enum]) -> str:
    # Python appends an underscore to some names; other languages do not.
    return ",".join(f"{enumerator.name.rstrip('_')}={enumerator.value}" for enumerator in enum)
