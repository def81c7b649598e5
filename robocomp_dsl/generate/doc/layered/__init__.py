"""Layered drawing of graphs: columns from left to right, as few crossings and bends as is easy.

In: boxes with sizes, and edges with labels. Out: where they are. The stages: `ranks` (columns),
`columns` (slots for the lines), `order` (crossings), `place` (places), `routes` (curves).
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.doc.layered.columns import columns_of
from robocomp_dsl.generate.doc.layered.graph import Edge, Layout, Node, Point, Route
from robocomp_dsl.generate.doc.layered.order import put_in_order
from robocomp_dsl.generate.doc.layered.place import column_places, heights
from robocomp_dsl.generate.doc.layered.ranks import Ranks, ranks_of, roomy
from robocomp_dsl.generate.doc.layered.routes import loops_above, route_all

__all__ = ["Edge", "Layout", "Node", "Point", "Ranks", "Route", "layout", "ranks_of", "roomy"]


def layout(nodes: Sequence[Node], edges: Sequence[Edge], ranks: Ranks | None = None) -> Layout:
    """Places for everything; `ranks` where they are known already. No two nodes overlap."""
    ranks = ranks or ranks_of(nodes, edges)
    loops = loops_above(len(nodes), edges)
    sizes = [
        (max(node.width, loop.width), node.height + loop.height)
        for node, loop in zip(nodes, loops, strict=True)
    ]
    columns = columns_of(sizes, edges, ranks)
    put_in_order(columns)
    at = heights(columns)
    places = column_places(columns, at)
    corners: list[Point] = []
    for i, node in enumerate(nodes):
        x, width = places[columns.items[i].column]
        top = at[i] - sizes[i][1] / 2 + loops[i].height
        corners.append((x + (width - node.width) / 2, top))
    routes = route_all(nodes, edges, corners, columns, ranks, at, places)
    width = max((x + w for x, w in places), default=0.0)
    bottoms = (y + item.height / 2 for y, item in zip(at, columns.items, strict=True))
    return Layout(width, max(bottoms, default=0.0), tuple(corners), tuple(routes))
