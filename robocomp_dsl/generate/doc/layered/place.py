"""Where everything is: heights in the columns, so that lines are straight, and the columns' places.

In: ordered columns. Out: the centre y of each item, the left edge and width of each column.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.doc.layered.columns import Columns, Item

SWEEPS = 12
BETWEEN_NODES = 26.0
BETWEEN_LINES = 14.0
NARROW, WIDE = 22.0, 90.0
"""Least and largest distance of two columns; it grows with how steep the lines between are."""


def heights(columns: Columns) -> list[float]:
    """The centre y of each item; the top of the topmost is at 0."""
    at = [0.0] * len(columns.items)
    for column in columns.order:
        _settle(column, columns.items, at, [0.0] * len(column), [1.0] * len(column))
    for sweep in range(SWEEPS):
        forth = sweep % 2 == 0
        for column in columns.order if forth else reversed(columns.order):
            pulls = [_pull(columns.items[i], columns.items, at, forth=forth) for i in column]
            wanted = [at[i] if p is None else p[0] for i, p in zip(column, pulls, strict=True)]
            weights = [0.01 if p is None else p[1] for p in pulls]
            _settle(column, columns.items, at, wanted, weights)
    top = min((y - item.height / 2 for y, item in zip(at, columns.items, strict=True)), default=0)
    return [y - top for y in at]


def _pull(
    item: Item, items: Sequence[Item], at: Sequence[float], *, forth: bool
) -> tuple[float, float] | None:
    """Where the neighbours on one side want it, and how strongly; lines want to be straight."""
    beside = item.before if forth else item.after
    if not beside:
        return None
    if len(beside) == 1:  # as of every place where a line only passes
        return at[beside[0]], 1.0 + 3.0 * (item.node < 0) + 3.0 * (items[beside[0]].node < 0)
    weights = [1.0 + 3.0 * (item.node < 0) + 3.0 * (items[b].node < 0) for b in beside]
    total = sum(weights)
    return sum(w * at[b] for w, b in zip(weights, beside, strict=True)) / total, total


def _settle(
    column: Sequence[int],
    items: Sequence[Item],
    at: list[float],
    wanted: Sequence[float],
    weights: Sequence[float],
) -> None:
    """Put a column as close to where it wants to be as order and distances allow.

    The least weighted squares, by pooling adjacent violators (Ayer et al. 1955).
    """
    blocks: list[tuple[float, float, list[int]]] = []  # weight, mean, items
    offset = 0.0
    offsets = {}
    for i, one in enumerate(column):
        if i:
            offset += _distance(items[column[i - 1]], items[one])
        offsets[one] = offset
        weight, mean, members = weights[i], wanted[i] - offset, [one]
        while blocks and blocks[-1][1] >= mean:
            above, level, held = blocks.pop()
            mean = (above * level + weight * mean) / (above + weight)
            weight += above
            members = held + members
        blocks.append((weight, mean, members))
    for _, mean, members in blocks:
        for one in members:
            at[one] = mean + offsets[one]


def _distance(upper: Item, lower: Item) -> float:
    lines = upper.node < 0 and lower.node < 0
    return (upper.height + lower.height) / 2 + (BETWEEN_LINES if lines else BETWEEN_NODES)


def column_places(columns: Columns, at: Sequence[float]) -> list[tuple[float, float]]:
    """The left edge and the width of each column; the first begins at 0."""
    made: list[tuple[float, float]] = []
    x = 0.0
    for column in columns.order:
        width = max((columns.items[i].width for i in column), default=0.0)
        made.append((x, width))
        steep = (abs(at[i] - at[j]) for i in column for j in columns.items[i].after)
        x += width + min(WIDE, NARROW + max(steep, default=0.0) * 0.15)
    return made
