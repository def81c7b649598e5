"""A configuration of yarp-bottle-generator as data, with the positions of its parts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from robocomp_dsl.source import Span

FUNCTIONS = ("none", "none_double", "deg_to_rad")
"""The converters of the original."""


@dataclass(frozen=True, slots=True)
class IniName:
    """A name of a port, topic or type."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class IniConstant:
    """A literal as written in C++: a text in quotes, a number, true or false."""

    value: str | int | float | bool
    span: Span


@dataclass(frozen=True, slots=True)
class ConstantField:
    """`single_value`."""

    constant: IniConstant
    span: Span


@dataclass(frozen=True, slots=True)
class ListField:
    """`list`; may be empty."""

    constants: tuple[IniConstant, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class TimeField:
    """`timestamp`."""

    span: Span


@dataclass(frozen=True, slots=True)
class CounterField:
    """`counter`."""

    span: Span


@dataclass(frozen=True, slots=True)
class MuxField:
    """`mux`: all values of `[mux<number>]`."""

    number: int
    span: Span


@dataclass(frozen=True, slots=True)
class NestedField:
    """`msg`: the fields of a nested section."""

    section: str
    fields: tuple[MessageField, ...]
    span: Span


MessageField: TypeAlias = (
    ConstantField | ListField | TimeField | CounterField | MuxField | NestedField
)


@dataclass(frozen=True, slots=True)
class Mux:
    """`[mux<number>]`: its inputs in order, and the converter of every value."""

    number: int
    ports: tuple[IniName, ...]
    function: str
    span: Span


@dataclass(frozen=True, slots=True)
class BottleConfiguration:
    """One file. `rate` None: as fast as the inputs; `message_type` None: it is not stated.

    `fields_span` covers the number of fields of `[message]`.
    """

    output: IniName
    to_ros: bool
    rate: float | None
    message_type: IniName | None
    muxes: tuple[Mux, ...]
    fields: tuple[MessageField, ...]
    fields_span: Span
