"""The nodes that every language's tree is made of.

Trees are what the user wrote and nothing more: names are not resolved, paths not followed, ranges
not judged. Every node is frozen and knows its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from robocomp_dsl.source import Span


@dataclass(frozen=True, slots=True)
class Node:
    """Something in a file; `span` runs from its first to its last character."""

    span: Span


@dataclass(frozen=True, slots=True)
class Name(Node):
    """An identifier, exactly as written."""

    text: str


@dataclass(frozen=True, slots=True)
class Text(Node):
    """A quoted text; `value` is without quotes and escapes, `span` with them."""

    value: str


@dataclass(frozen=True, slots=True)
class Number(Node):
    """A number; an `int` when it was written as one."""

    value: int | float


@dataclass(frozen=True, slots=True)
class Bool(Node):
    """`true` or `false`."""

    value: bool


Literal: TypeAlias = Text | Number | Bool | Name
"""A value as written; a `Name` is an enumerator or a bare word."""


@dataclass(frozen=True, slots=True)
class Unit(Node):
    """`[mm]`; `text` is what stands between the brackets."""

    text: str


@dataclass(frozen=True, slots=True)
class Import(Node):
    """`import "path";` with the path as written."""

    path: Text


@dataclass(frozen=True, slots=True)
class QualifiedName(Node):
    """`Name` or `Module::Name`."""

    name: Name
    module: Name | None = None

    @property
    def text(self) -> str:
        """As users write it."""
        return f"{self.module.text}::{self.name.text}" if self.module else self.name.text


@dataclass(frozen=True, slots=True)
class Duration(Node):
    """`10 s`, `40 ms` or `2 min`, in seconds."""

    seconds: float
