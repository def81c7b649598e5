"""Graphs before and after they are laid out. Lengths are pixels, x to the right, y down."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]


@dataclass(frozen=True, slots=True)
class LayoutNode:
    """A box. `border` "first" or "last" places it left or right of all other nodes."""

    width: float
    height: float
    border: str = ""


@dataclass(frozen=True, slots=True)
class LayoutEdge:
    """An edge between nodes, by their indices; `width` and `height` are the size of its label.

    `leaves` and `enters` fix its end points on the nodes, as distances from their tops.
    """

    source: int
    target: int
    width: float = 0.0
    height: float = 0.0
    source_offset: float | None = None
    target_offset: float | None = None


@dataclass(frozen=True, slots=True)
class EdgeRoute:
    """Cubic Bézier curves, concatenated: start, control, control, end, control, ….

    `label` is the centre of the label.
    """

    points: tuple[Point, ...]
    label: Point


@dataclass(frozen=True, slots=True)
class GraphLayout:
    """The upper left corners of the nodes and the routes of the edges, in input order."""

    width: float
    height: float
    nodes: tuple[Point, ...]
    routes: tuple[EdgeRoute, ...]
