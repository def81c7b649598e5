"""Layered drawing of graphs: columns from left to right, with few crossings and bends.

In: boxes with sizes, and edges with labels. Out: their positions. The stages: `ranks` (columns),
`columns` (slots for the lines), `order` (crossings), `place` (coordinates), `routes` (curves).
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.doc.layered.columns import build_columns
from robocomp_dsl.generate.doc.layered.graph import (
    EdgeRoute,
    GraphLayout,
    LayoutEdge,
    LayoutNode,
    Point,
)
from robocomp_dsl.generate.doc.layered.order import minimize_crossings
from robocomp_dsl.generate.doc.layered.place import assign_coordinates, column_extents
from robocomp_dsl.generate.doc.layered.ranks import Ranks, assign_ranks, fit_ports
from robocomp_dsl.generate.doc.layered.routes import measure_self_loops, route_edges

__all__ = [
    "EdgeRoute",
    "GraphLayout",
    "LayoutEdge",
    "LayoutNode",
    "Point",
    "Ranks",
    "assign_ranks",
    "fit_ports",
    "layout",
]


def layout(
    nodes: Sequence[LayoutNode], edges: Sequence[LayoutEdge], ranks: Ranks | None = None
) -> GraphLayout:
    """Positions of all parts, without overlap of nodes; `ranks` may be passed if known."""
    ranks = ranks or assign_ranks(nodes, edges)
    loops = measure_self_loops(len(nodes), edges)
    sizes = [
        (max(node.width, loop.width), node.height + loop.height)
        for node, loop in zip(nodes, loops, strict=True)
    ]
    columns = build_columns(sizes, edges, ranks)
    minimize_crossings(columns)
    centres = assign_coordinates(columns)
    places = column_extents(columns, centres)
    corners: list[Point] = []
    for i, node in enumerate(nodes):
        x, width = places[columns.items[i].column]
        top = centres[i] - sizes[i][1] / 2 + loops[i].height
        corners.append((x + (width - node.width) / 2, top))
    routes = route_edges(nodes, edges, corners, columns, ranks, centres, places)
    width = max((x + w for x, w in places), default=0.0)
    bottoms = (y + item.height / 2 for y, item in zip(centres, columns.items, strict=True))
    return GraphLayout(width, max(bottoms, default=0.0), tuple(corners), tuple(routes))
