"""Graphs of named boxes and labelled lines, drawn.

In: nodes and edges. Out: a `Drawing`. Nodes without any line stand in rows below the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.generate.doc import layered
from robocomp_dsl.generate.doc.drawing import (
    LINE,
    Box,
    Drawing,
    Label,
    Line,
    line,
    shifted,
    text_width,
)
from robocomp_dsl.generate.doc.words import Target

MARGIN = 12.0
PADDING = 16.0
LEAST = 96.0
ROW = 760.0
"""Width of the rows of nodes without lines, unless the graph is wider."""
GAP = 24.0


@dataclass(frozen=True, slots=True)
class GraphNode:
    """A box: `name` leads to `target`, `below` is a smaller second line."""

    name: str
    kind: str
    target: Target | None = None
    below: str = ""
    about: str = ""
    corner: float = 8.0


@dataclass(frozen=True, slots=True)
class GraphEdge:
    """A line between nodes, by their indices, with a label of several lines that may be links."""

    source: int
    target: int
    kind: str
    labels: tuple[tuple[str, Target | None], ...] = ()
    about: str = ""


def drawn(
    title: str, about: str, nodes: Sequence[GraphNode], edges: Sequence[GraphEdge]
) -> Drawing:
    """All nodes and edges, laid out."""
    joined = {end for edge in edges for end in (edge.source, edge.target)}
    inner = [i for i in range(len(nodes)) if i in joined]
    at = {node: place for place, node in enumerate(inner)}
    sizes = [_size(node) for node in nodes]
    lines = [layered.Edge(at[e.source], at[e.target], *label_size(e.labels)) for e in edges]
    ranks = layered.ranks_of([sizes[i] for i in inner], lines)
    boxes = layered.roomy([sizes[i] for i in inner], lines, ranks)
    made = layered.layout(boxes, lines, ranks)
    places = dict(zip(inner, zip(boxes, made.nodes, strict=True), strict=True))
    alone = [(i, size) for i, size in enumerate(sizes) if i not in joined]
    width, height = _rows(alone, places, made)
    return Drawing(
        width + 2 * MARGIN,
        height + 2 * MARGIN,
        title,
        about,
        parts=(
            *(_line(e, r) for e, r in zip(edges, made.routes, strict=True)),
            *(_label(e, r) for e, r in zip(edges, made.routes, strict=True) if e.labels),
            *(_box(node, *places[i]) for i, node in enumerate(nodes)),
        ),
    )


def _size(node: GraphNode) -> layered.Node:
    width = max(text_width(node.name), text_width(node.below) * 0.92)
    return layered.Node(max(LEAST, width + 2 * PADDING), LINE * (1 + bool(node.below)) + PADDING)


def label_size(labels: Sequence[tuple[str, Target | None]]) -> tuple[float, float]:
    """What the words of a line need."""
    if not labels:
        return 0.0, 0.0
    return max(text_width(words) for words, _ in labels) + 8, LINE * len(labels)


def _rows(
    alone: Sequence[tuple[int, layered.Node]],
    places: dict[int, tuple[layered.Node, layered.Point]],
    made: layered.Layout,
) -> tuple[float, float]:
    """Put nodes below the graph, row by row; the size of everything."""
    width, room = made.width, max(made.width, ROW)
    x, y, height = 0.0, made.height + GAP * bool(made.nodes), made.height
    for i, size in alone:
        if x and x + size.width > room:
            x, y = 0.0, height + GAP
        places[i] = (size, (x, y))
        x += size.width + GAP
        width, height = max(width, x - GAP), max(height, y + size.height)
    return width, height


def _line(edge: GraphEdge, route: layered.Route) -> Line:
    return line(shifted(route.points, MARGIN, MARGIN), edge.kind, edge.about)


def _label(edge: GraphEdge, route: layered.Route) -> Box:
    return plate(edge.labels, edge.kind, route.label[0] + MARGIN, route.label[1] + MARGIN)


def _box(node: GraphNode, size: layered.Node, corner: layered.Point) -> Box:
    left, top = corner[0] + MARGIN, corner[1] + MARGIN
    centre, middle = left + size.width / 2, top + size.height / 2
    names = [Label(centre, middle - (LINE / 2 if node.below else 0), node.name, "name")]
    if node.below:
        names.append(Label(centre, middle + LINE / 2, node.below, "below"))
    return Box(
        left,
        top,
        size.width,
        size.height,
        node.kind,
        node.about,
        node.corner,
        tuple(names),
        node.target,
    )


def plate(labels: Sequence[tuple[str, Target | None]], kind: str, x: float, y: float) -> Box:
    """The words of a line around (x, y), on a plate that hides what is behind it."""
    width, height = label_size(labels)
    top = y - height / 2
    words = tuple(
        Label(x, top + LINE * (i + 0.5), said, kind, target)
        for i, (said, target) in enumerate(labels)
    )
    return Box(x - width / 2, top, width, height, "plate", corner=3.0, labels=words)
