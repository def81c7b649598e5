"""The tree of a PDSL file: the parameters of one component, in nested groups."""

from __future__ import annotations

from typing import TypeAlias

from robocomp_dsl.syntax.ast.base import Literal, LiteralList, Name, Node, Number, Unit


class Range(Node):
    """`low:high`, both inclusive; one side may be open (`0:`, `:100`)."""

    low: Number | None
    high: Number | None


class Enumeration(Node):
    """`{position, velocity}` instead of a type."""

    choices: tuple[Name, ...]


class Parameter(Node):
    """`rate float 50 [Hz] 1:1000 live;`; `weights[1:8] float {1.0, 2.0};` is a list of values.

    `type` is the identifier as written (possibly invalid) or an enumeration. `default` is a `Name`
    for an enumeration. `count` is the length of a list. The historical flag `T` is accepted and
    ignored.
    """

    name: Name
    type: Name | Enumeration
    default: Literal | LiteralList | None = None
    unit: Unit | None = None
    range: Range | None = None
    live: bool = False
    count: Range | None = None
    doc: str = ""


class Group(Node):
    """`motors[1:32] { … };` is a list of groups, `pid { … };` (no `count`) a single one.

    `motors[3]` is a range from 3 to 3, `motors[]` a range open on both sides.
    """

    name: Name
    members: tuple[Member, ...]
    count: Range | None = None
    doc: str = ""


Member: TypeAlias = Parameter | Group


class ParameterSet(Node):
    """`ComponentParams name { … };`."""

    name: Name
    members: tuple[Member, ...]
    doc: str = ""


class File(Node):
    """One PDSL file; `parameters` is None if the file has no block.

    `complete` is False if syntax errors were reported, so parts may be missing.
    """

    parameters: ParameterSet | None
    complete: bool = True
