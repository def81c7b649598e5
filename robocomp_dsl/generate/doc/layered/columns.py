"""Columns of a graph: nodes, and a slot for each edge in each column that it passes.

In: ranks. Out: columns; nodes stand in the even ones, labels in odd ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from robocomp_dsl.generate.doc.layered.graph import Edge
from robocomp_dsl.generate.doc.layered.ranks import Ranks


@dataclass(slots=True)
class Item:
    """A node, or where an edge passes a column; `node` and `edge` are -1 for the other.

    `before` and `after` are the items it is joined to in the columns beside it.
    """

    column: int
    width: float = 0.0
    height: float = 0.0
    node: int = -1
    edge: int = -1
    labelled: bool = False
    before: list[int] = field(default_factory=list)
    after: list[int] = field(default_factory=list)


@dataclass(slots=True)
class Columns:
    """All items; `order` has those of each column, from the top down.

    `ways` are the items between the ends of each edge, from left to right.
    """

    items: list[Item]
    order: list[list[int]]
    ways: list[list[int]]


def columns_of(
    sizes: Sequence[tuple[float, float]], edges: Sequence[Edge], ranks: Ranks
) -> Columns:
    """Items in the order in which nodes and edges are given; those of nodes come first."""
    last = max(ranks.of, default=0) * 2
    items = [
        Item(rank * 2, *size, node=i)
        for i, (rank, size) in enumerate(zip(ranks.of, sizes, strict=True))
    ]
    made = Columns(items, [[] for _ in range(last + 1)], [])
    for i, item in enumerate(items):
        made.order[item.column].append(i)
    for i, edge in enumerate(edges):
        made.ways.append(_way(i, edge, ranks, made) if edge.source != edge.target else [])
    return made


def _way(index: int, edge: Edge, ranks: Ranks, made: Columns) -> list[int]:
    left, right = ranks.ends(index, edge)
    first, last = ranks.of[left] * 2, ranks.of[right] * 2
    middle = (first + last) // 2
    label = middle if middle % 2 else middle - 1
    way = []
    held = left
    for column in range(first + 1, last):
        item = Item(column, edge=index)
        if column == label and edge.width:
            item = Item(column, edge.width, edge.height, edge=index, labelled=True)
        made.items.append(item)
        at = len(made.items) - 1
        made.order[column].append(at)
        way.append(at)
        _join(made.items, held, at)
        held = at
    _join(made.items, held, right)
    return way


def _join(items: list[Item], left: int, right: int) -> None:
    items[left].after.append(right)
    items[right].before.append(left)
