"""The curves of the edges.

In: positions of nodes, and the slots of each edge. Out: a `Route` for each edge. The edges on one
side of a node are spread over its height, ordered by the positions of their other ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.generate.doc.layered.columns import Columns
from robocomp_dsl.generate.doc.layered.graph import EdgeRoute, LayoutEdge, LayoutNode, Point
from robocomp_dsl.generate.doc.layered.ranks import Ranks

LOOP_HEIGHT = 16.0
"""Height of a self-loop above its node, without its label."""
LOOP_HALF_WIDTH = 12.0


@dataclass(slots=True)
class SelfLoops:
    """Space above a node for its self-loops."""

    width: float = 0.0
    height: float = 0.0


def measure_self_loops(count: int, edges: Sequence[LayoutEdge]) -> list[SelfLoops]:
    """The space that each node needs."""
    loops = [SelfLoops() for _ in range(count)]
    for edge in edges:
        if edge.source == edge.target:
            loop = loops[edge.source]
            loop.width = max(loop.width, edge.width)
            loop.height += LOOP_HEIGHT + edge.height
    return loops


def route_edges(
    nodes: Sequence[LayoutNode],
    edges: Sequence[LayoutEdge],
    corners: Sequence[Point],
    columns: Columns,
    ranks: Ranks,
    centres: Sequence[float],
    places: Sequence[tuple[float, float]],
) -> list[EdgeRoute]:
    """The routes of all edges, in their order."""
    ports = _assign_ports(nodes, edges, corners, columns, ranks, centres)
    risen = [0.0] * len(nodes)
    routes = []
    for i, edge in enumerate(edges):
        if edge.source == edge.target:
            routes.append(_loop(edge, nodes[edge.source], corners[edge.source], risen))
            continue
        left, right = ranks.ends(i, edge)
        spans = [(x := corners[left][0] + nodes[left].width, x, ports[i][0])]
        for item in columns.edge_items[i]:
            x, width = places[columns.items[item].column]
            spans.append((x, x + width, centres[item]))
        x = corners[right][0]
        spans.append((x, x, ports[i][1]))
        points = _curve(spans)
        label = next((item for item in columns.edge_items[i] if columns.items[item].labelled), None)
        centre = points[0]
        if label is not None:
            x, width = places[columns.items[label].column]
            centre = (x + width / 2, centres[label])
        routes.append(EdgeRoute(points[::-1] if i in ranks.reversed_edges else points, centre))
    return routes


def _assign_ports(
    nodes: Sequence[LayoutNode],
    edges: Sequence[LayoutEdge],
    corners: Sequence[Point],
    columns: Columns,
    ranks: Ranks,
    centres: Sequence[float],
) -> list[tuple[float, float]]:
    """For each edge the y of its end at the left and at the right node."""
    sides: dict[tuple[int, int], list[tuple[float, int]]] = {}
    for i, edge in enumerate(edges):
        if edge.source != edge.target:
            left, right = ranks.ends(i, edge)
            path = columns.edge_items[i]
            sides.setdefault((left, 0), []).append((centres[path[0]], i))
            sides.setdefault((right, 1), []).append((centres[path[-1]], i))
    ports = {}
    for (node, side), ends in sides.items():
        for place, (_, i) in enumerate(sorted(ends), 1):
            turned = i in ranks.reversed_edges
            fixed = edges[i].source_offset if (side == 0) is not turned else edges[i].target_offset
            share = nodes[node].height * place / (len(ends) + 1)
            ports[i, side] = corners[node][1] + (share if fixed is None else fixed)
    return [(ports.get((i, 0), 0.0), ports.get((i, 1), 0.0)) for i in range(len(edges))]


def _curve(spans: Sequence[tuple[float, float, float]]) -> tuple[Point, ...]:
    """Through horizontal segments (from x, to x, y), joined by S-curves."""
    points: list[Point] = [(spans[0][0], spans[0][2])]
    for start, end, y in spans:
        x, held = points[-1]
        if start > x:
            middle = (x + start) / 2
            points += [(middle, held), (middle, y), (start, y)]
        if end > start:
            third = (end - start) / 3
            points += [(start + third, y), (end - third, y), (end, y)]
    return tuple(points)


def _loop(edge: LayoutEdge, node: LayoutNode, corner: Point, risen: list[float]) -> EdgeRoute:
    """A self-loop at the top of a node; each further one encloses the previous one."""
    low = risen[edge.source]
    risen[edge.source] += LOOP_HEIGHT + edge.height
    foot = min(LOOP_HALF_WIDTH * (1 + low / (LOOP_HEIGHT + edge.height)), node.width / 2)
    x, y = corner[0] + node.width / 2, corner[1]
    peak = y - low - LOOP_HEIGHT  # the curve itself reaches three quarters of it
    points = ((x - foot, y), (x - foot, peak), (x + foot, peak), (x + foot, y))
    return EdgeRoute(points, (x, y - low - LOOP_HEIGHT - edge.height / 2))
