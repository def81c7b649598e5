"""The curves of the edges.

In: where nodes are and which slots an edge passes. Out: a `Route` for each edge. The edges on one
side of a node are spread over its height in the order of where they lead to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.generate.doc.layered.columns import Columns
from robocomp_dsl.generate.doc.layered.graph import Edge, Node, Point, Route
from robocomp_dsl.generate.doc.layered.ranks import Ranks

LOOP = 16.0
"""How high an edge from a node to itself rises above it, without its label."""
FOOT = 12.0


@dataclass(slots=True)
class Loops:
    """Room above a node for the edges that lead from it to itself."""

    width: float = 0.0
    height: float = 0.0


def loops_above(count: int, edges: Sequence[Edge]) -> list[Loops]:
    """The room that each node needs."""
    made = [Loops() for _ in range(count)]
    for edge in edges:
        if edge.source == edge.target:
            loop = made[edge.source]
            loop.width = max(loop.width, edge.width)
            loop.height += LOOP + edge.height
    return made


def route_all(
    nodes: Sequence[Node],
    edges: Sequence[Edge],
    corners: Sequence[Point],
    columns: Columns,
    ranks: Ranks,
    at: Sequence[float],
    places: Sequence[tuple[float, float]],
) -> list[Route]:
    """The routes of all edges, in their order."""
    ports = _ports(nodes, edges, corners, columns, ranks, at)
    risen = [0.0] * len(nodes)
    made = []
    for i, edge in enumerate(edges):
        if edge.source == edge.target:
            made.append(_loop(edge, nodes[edge.source], corners[edge.source], risen))
            continue
        left, right = ranks.ends(i, edge)
        spans = [(x := corners[left][0] + nodes[left].width, x, ports[i][0])]
        for one in columns.ways[i]:
            x, width = places[columns.items[one].column]
            spans.append((x, x + width, at[one]))
        x = corners[right][0]
        spans.append((x, x, ports[i][1]))
        points = _curve(spans)
        label = next((one for one in columns.ways[i] if columns.items[one].labelled), None)
        centre = points[0]
        if label is not None:
            x, width = places[columns.items[label].column]
            centre = (x + width / 2, at[label])
        made.append(Route(points[::-1] if i in ranks.turned else points, centre))
    return made


def _ports(
    nodes: Sequence[Node],
    edges: Sequence[Edge],
    corners: Sequence[Point],
    columns: Columns,
    ranks: Ranks,
    at: Sequence[float],
) -> list[tuple[float, float]]:
    """For each edge the y at which it leaves its left and enters its right node."""
    sides: dict[tuple[int, int], list[tuple[float, int]]] = {}
    for i, edge in enumerate(edges):
        if edge.source != edge.target:
            left, right = ranks.ends(i, edge)
            way = columns.ways[i]
            sides.setdefault((left, 0), []).append((at[way[0]], i))
            sides.setdefault((right, 1), []).append((at[way[-1]], i))
    ports = {}
    for (node, side), found in sides.items():
        for place, (_, i) in enumerate(sorted(found), 1):
            turned = i in ranks.turned
            fixed = edges[i].leaves if (side == 0) is not turned else edges[i].enters
            share = nodes[node].height * place / (len(found) + 1)
            ports[i, side] = corners[node][1] + (share if fixed is None else fixed)
    return [(ports.get((i, 0), 0.0), ports.get((i, 1), 0.0)) for i in range(len(edges))]


def _curve(spans: Sequence[tuple[float, float, float]]) -> tuple[Point, ...]:
    """Through level stretches (from x, to x, y), with an S between each two."""
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


def _loop(edge: Edge, node: Node, corner: Point, risen: list[float]) -> Route:
    """Out of the top of a node and back into it; each further one is outside of the last."""
    low = risen[edge.source]
    risen[edge.source] += LOOP + edge.height
    foot = min(FOOT * (1 + low / (LOOP + edge.height)), node.width / 2)
    x, y = corner[0] + node.width / 2, corner[1]
    peak = y - low - LOOP  # the curve itself rises to three quarters of it
    points = ((x - foot, y), (x - foot, peak), (x + foot, peak), (x + foot, y))
    return Route(points, (x, y - low - LOOP - edge.height / 2))
