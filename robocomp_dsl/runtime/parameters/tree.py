"""A configuration as a tree in which every node has its location.

All sources (YAML, TOML, `--set`) are converted to this form; the checks use no other. Scalars keep
their text, because only the schema decides whether `1e-3`, `on` or `010` is a number.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

from robocomp_dsl.finding import Location


class TextSyntax(Enum):
    """How a scalar was written: as in `x: 5`, as in `x: "5"`, or on a command line."""

    PLAIN = "plain"
    QUOTED = "quoted"
    RAW = "raw"


@dataclass(frozen=True, slots=True)
class Scalar:
    """One value, not yet interpreted."""

    place: Location
    text: str
    style: TextSyntax = TextSyntax.PLAIN


@dataclass(frozen=True, slots=True)
class Items:
    """A list."""

    place: Location
    items: list[Node]


@dataclass(frozen=True, slots=True)
class Member:
    """One `key: value`; `place` is the location of the key."""

    place: Location
    value: Node


@dataclass(frozen=True, slots=True)
class Mapping:
    """Keys and values in order of writing."""

    place: Location
    members: dict[str, Member] = field(default_factory=dict)


Node: TypeAlias = Scalar | Items | Mapping

NODE_NAMES: dict[type[Node], str] = {Scalar: "a single value", Items: "a list", Mapping: "a group"}
"""Names of the node types in messages."""
