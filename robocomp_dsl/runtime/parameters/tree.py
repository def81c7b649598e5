"""A configuration as a tree in which every node knows where it was written.

All sources (YAML, TOML, `--set`) become this one shape; the checks know no other. Scalars keep
their text, because only the schema tells whether `1e-3`, `on` or `010` is a number.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import TypeAlias

from robocomp_dsl.runtime.parameters.findings import Place


class Style(Enum):
    """How a scalar was written: as in `x: 5`, as in `x: "5"`, or on a command line."""

    PLAIN = "plain"
    QUOTED = "quoted"
    RAW = "raw"


@dataclass(frozen=True, slots=True)
class Scalar:
    """One value, not yet interpreted."""

    place: Place
    text: str
    style: Style = Style.PLAIN


@dataclass(frozen=True, slots=True)
class Items:
    """A list."""

    place: Place
    items: list[Node]


@dataclass(frozen=True, slots=True)
class Member:
    """One `key: value`; `place` is that of the key."""

    place: Place
    value: Node


@dataclass(frozen=True, slots=True)
class Mapping:
    """Keys and values in order of writing."""

    place: Place
    members: dict[str, Member] = field(default_factory=dict)


Node: TypeAlias = Scalar | Items | Mapping

CALLED: dict[type[Node], str] = {Scalar: "a single value", Items: "a list", Mapping: "a group"}
"""How messages call each shape."""
