"""Draw graphs of named boxes and labelled lines.

In: nodes and edges. Out: a `Drawing`. Nodes without edges are in rows below the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.generate.doc.drawing import (
    LINE_HEIGHT,
    Curve,
    Drawing,
    Label,
    Rectangle,
    draw_curve,
    text_width,
    translate,
)
from robocomp_dsl.generate.doc.layered import layout as layered
from robocomp_dsl.generate.doc.target import Target

MARGIN = 12.0
PADDING = 16.0
MIN_NODE_WIDTH = 96.0
ROW_WIDTH = 760.0
"""Width of the rows of nodes without lines, unless the graph is wider."""
GAP = 24.0


@dataclass(frozen=True, slots=True)
class GraphNode:
    """A box: `name` is a link to `target`, `subtitle` is a smaller second line."""

    name: str
    kind: str
    target: Target | None = None
    subtitle: str = ""
    tooltip: str = ""
    corner: float = 8.0


@dataclass(frozen=True, slots=True)
class GraphEdge:
    """An edge between nodes, by their indices; the lines of its label may be links."""

    source: int
    target: int
    kind: str
    labels: tuple[tuple[str, Target | None], ...] = ()
    tooltip: str = ""


def draw_graph(
    title: str, about: str, nodes: Sequence[GraphNode], edges: Sequence[GraphEdge]
) -> Drawing:
    """Lay out and draw all nodes and edges."""
    joined = {end for edge in edges for end in (edge.source, edge.target)}
    inner = [i for i in range(len(nodes)) if i in joined]
    position = {node: place for place, node in enumerate(inner)}
    sizes = [_size(node) for node in nodes]
    lines = [
        layered.LayoutEdge(position[e.source], position[e.target], *label_size(e.labels))
        for e in edges
    ]
    ranks = layered.assign_ranks([sizes[i] for i in inner], lines)
    boxes = layered.fit_ports([sizes[i] for i in inner], lines, ranks)
    layout = layered.layout(boxes, lines, ranks)
    places = dict(zip(inner, zip(boxes, layout.nodes, strict=True), strict=True))
    alone = [(i, size) for i, size in enumerate(sizes) if i not in joined]
    width, height = _place_unconnected(alone, places, layout)
    return Drawing(
        width + 2 * MARGIN,
        height + 2 * MARGIN,
        title,
        about,
        parts=(
            *(_edge_curve(e, r) for e, r in zip(edges, layout.routes, strict=True)),
            *(_edge_label(e, r) for e, r in zip(edges, layout.routes, strict=True) if e.labels),
            *(_node_rectangle(node, *places[i]) for i, node in enumerate(nodes)),
        ),
    )


def _size(node: GraphNode) -> layered.LayoutNode:
    width = max(text_width(node.name), text_width(node.subtitle) * 0.92)
    return layered.LayoutNode(
        max(MIN_NODE_WIDTH, width + 2 * PADDING), LINE_HEIGHT * (1 + bool(node.subtitle)) + PADDING
    )


def label_size(labels: Sequence[tuple[str, Target | None]]) -> tuple[float, float]:
    """Width and height of an edge's label."""
    if not labels:
        return 0.0, 0.0
    return max(text_width(words) for words, _ in labels) + 8, LINE_HEIGHT * len(labels)


def _place_unconnected(
    alone: Sequence[tuple[int, layered.LayoutNode]],
    places: dict[int, tuple[layered.LayoutNode, layered.Point]],
    layout: layered.GraphLayout,
) -> tuple[float, float]:
    """Place nodes below the graph in rows; the total size."""
    width, room = layout.width, max(layout.width, ROW_WIDTH)
    x, y, height = 0.0, layout.height + GAP * bool(layout.nodes), layout.height
    for i, size in alone:
        if x and x + size.width > room:
            x, y = 0.0, height + GAP
        places[i] = (size, (x, y))
        x += size.width + GAP
        width, height = max(width, x - GAP), max(height, y + size.height)
    return width, height


def _edge_curve(edge: GraphEdge, route: layered.EdgeRoute) -> Curve:
    return draw_curve(translate(route.points, MARGIN, MARGIN), edge.kind, edge.tooltip)


def _edge_label(edge: GraphEdge, route: layered.EdgeRoute) -> Rectangle:
    return label_plate(edge.labels, edge.kind, route.label[0] + MARGIN, route.label[1] + MARGIN)


def _node_rectangle(node: GraphNode, size: layered.LayoutNode, corner: layered.Point) -> Rectangle:
    left, top = corner[0] + MARGIN, corner[1] + MARGIN
    centre, middle = left + size.width / 2, top + size.height / 2
    names = [Label(centre, middle - (LINE_HEIGHT / 2 if node.subtitle else 0), node.name, "name")]
    if node.subtitle:
        names.append(Label(centre, middle + LINE_HEIGHT / 2, node.subtitle, "below"))
    return Rectangle(
        left,
        top,
        size.width,
        size.height,
        node.kind,
        node.tooltip,
        node.corner,
        tuple(names),
        node.target,
    )


def label_plate(
    labels: Sequence[tuple[str, Target | None]], kind: str, x: float, y: float
) -> Rectangle:
    """The label of an edge at (x, y), on an opaque rectangle."""
    width, height = label_size(labels)
    top = y - height / 2
    words = tuple(
        Label(x, top + LINE_HEIGHT * (i + 0.5), text, kind, target)
        for i, (text, target) in enumerate(labels)
    )
    return Rectangle(x - width / 2, top, width, height, "plate", corner=3.0, labels=words)
