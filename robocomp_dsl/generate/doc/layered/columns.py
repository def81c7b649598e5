"""Columns of a graph: nodes, and a slot for each edge in each column that it passes.

In: ranks. Out: columns; nodes are in even columns, labels in odd ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from robocomp_dsl.generate.doc.layered.graph import LayoutEdge
from robocomp_dsl.generate.doc.layered.ranks import Ranks


@dataclass(slots=True)
class ColumnItem:
    """A node, or the slot of an edge in a column; the other of `node` and `edge` is -1.

    `before` and `after` are the connected items in the neighbouring columns.
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

    `edge_items` are the items between the ends of each edge, from left to right.
    """

    items: list[ColumnItem]
    order: list[list[int]]
    edge_items: list[list[int]]


def build_columns(
    sizes: Sequence[tuple[float, float]], edges: Sequence[LayoutEdge], ranks: Ranks
) -> Columns:
    """Items in the order of nodes and edges; the items of nodes come first."""
    last = max(ranks.by_node, default=0) * 2
    items = [
        ColumnItem(rank * 2, *size, node=i)
        for i, (rank, size) in enumerate(zip(ranks.by_node, sizes, strict=True))
    ]
    columns = Columns(items, [[] for _ in range(last + 1)], [])
    for i, item in enumerate(items):
        columns.order[item.column].append(i)
    for i, edge in enumerate(edges):
        columns.edge_items.append(
            _add_edge_items(i, edge, ranks, columns) if edge.source != edge.target else []
        )
    return columns


def _add_edge_items(index: int, edge: LayoutEdge, ranks: Ranks, columns: Columns) -> list[int]:
    left, right = ranks.ends(index, edge)
    first, last = ranks.by_node[left] * 2, ranks.by_node[right] * 2
    middle = (first + last) // 2
    label = middle if middle % 2 else middle - 1
    path = []
    previous = left
    for column in range(first + 1, last):
        item = ColumnItem(column, edge=index)
        if column == label and edge.width:
            item = ColumnItem(column, edge.width, edge.height, edge=index, labelled=True)
        columns.items.append(item)
        item_index = len(columns.items) - 1
        columns.order[column].append(item_index)
        path.append(item_index)
        _connect(columns.items, previous, item_index)
        previous = item_index
    _connect(columns.items, previous, right)
    return path


def _connect(items: list[ColumnItem], left: int, right: int) -> None:
    items[left].after.append(right)
    items[right].before.append(left)
