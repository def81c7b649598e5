"""Syntax tree nodes that all languages share.

A tree represents the text only: names are not resolved, paths not followed, values not checked.
"""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.syntax.ast.node import Node

__all__ = [
    "Bool",
    "Duration",
    "Import",
    "Literal",
    "LiteralList",
    "Name",
    "Node",
    "Number",
    "QualifiedName",
    "Text",
    "Unit",
]


class Name(Node):
    """An identifier, exactly as written."""

    text: str


class Text(Node):
    """A string literal; `value` is without quotes and escapes, `span` includes them."""

    value: str


class Number(Node):
    """A number; an `int` if it was written without a fraction."""

    value: int | float


class Bool(Node):
    """`true` or `false`."""

    value: bool


Literal: TypeAlias = Text | Number | Bool | Name
"""A value as written; a `Name` is an enumerator or a bare word."""


class LiteralList(Node):
    """`{1.0, 2.0}`: the values of a list."""

    items: tuple[Literal, ...]


class Unit(Node):
    """`[mm]`; `text` is the text between the brackets."""

    text: str


class Import(Node):
    """`import "path";` with the path as written."""

    path: Text


class QualifiedName(Node):
    """`Name` or `Module::Name`."""

    name: Name
    module: Name | None = None

    @property
    def text(self) -> str:
        """As users write it."""
        return f"{self.module.text}::{self.name.text}" if self.module else self.name.text


class Duration(Node):
    """`10 s`, `40 ms` or `2 min`, in seconds."""

    seconds: float
