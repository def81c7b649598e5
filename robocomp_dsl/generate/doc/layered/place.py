"""Assign coordinates: y in the columns, so that lines are straight, and the columns' extents.

In: ordered columns. Out: the centre y of each item, the left edge and width of each column.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.doc.layered.columns import ColumnItem, Columns

SWEEPS = 12
NODE_GAP = 26.0
LINE_GAP = 14.0
MIN_COLUMN_GAP, MAX_COLUMN_GAP = 22.0, 90.0
"""Smallest and largest gap of two columns; it grows with the slope of the lines between them."""


def assign_coordinates(columns: Columns) -> list[float]:
    """The centre y of each item; the top of the topmost is at 0."""
    centres = [0.0] * len(columns.items)
    for column in columns.order:
        _place_column(column, columns.items, centres, [0.0] * len(column), [1.0] * len(column))
    for sweep in range(SWEEPS):
        forth = sweep % 2 == 0
        for column in columns.order if forth else reversed(columns.order):
            pulls = [
                _neighbour_mean(columns.items[i], columns.items, centres, forth=forth)
                for i in column
            ]
            targets = [
                centres[i] if p is None else p[0] for i, p in zip(column, pulls, strict=True)
            ]
            weights = [0.01 if p is None else p[1] for p in pulls]
            _place_column(column, columns.items, centres, targets, weights)
    top = min(
        (y - item.height / 2 for y, item in zip(centres, columns.items, strict=True)), default=0
    )
    return [y - top for y in centres]


def _neighbour_mean(
    item: ColumnItem, items: Sequence[ColumnItem], centres: Sequence[float], *, forth: bool
) -> tuple[float, float] | None:
    """Weighted mean y of the neighbours on one side, and the weight; None if there are none."""
    neighbours = item.before if forth else item.after
    if not neighbours:
        return None
    if len(neighbours) == 1:  # as of every slot of a passing line
        return centres[neighbours[0]], 1.0 + 3.0 * (item.node < 0) + 3.0 * (
            items[neighbours[0]].node < 0
        )
    weights = [1.0 + 3.0 * (item.node < 0) + 3.0 * (items[b].node < 0) for b in neighbours]
    total = sum(weights)
    return sum(w * centres[b] for w, b in zip(weights, neighbours, strict=True)) / total, total


def _place_column(
    column: Sequence[int],
    items: Sequence[ColumnItem],
    centres: list[float],
    targets: Sequence[float],
    weights: Sequence[float],
) -> None:
    """Place a column as close to `targets` as order and distances allow.

    Weighted least squares, by pooling adjacent violators (Ayer et al. 1955).
    """
    blocks: list[tuple[float, float, list[int]]] = []  # weight, mean, items
    offset = 0.0
    offsets = {}
    for i, index in enumerate(column):
        if i:
            offset += _distance(items[column[i - 1]], items[index])
        offsets[index] = offset
        weight, mean, members = weights[i], targets[i] - offset, [index]
        while blocks and blocks[-1][1] >= mean:
            above, level, held = blocks.pop()
            mean = (above * level + weight * mean) / (above + weight)
            weight += above
            members = held + members
        blocks.append((weight, mean, members))
    for _, mean, members in blocks:
        for member in members:
            centres[member] = mean + offsets[member]


def _distance(upper: ColumnItem, lower: ColumnItem) -> float:
    lines = upper.node < 0 and lower.node < 0
    return (upper.height + lower.height) / 2 + (LINE_GAP if lines else NODE_GAP)


def column_extents(columns: Columns, centres: Sequence[float]) -> list[tuple[float, float]]:
    """The left edge and the width of each column; the first begins at 0."""
    extents: list[tuple[float, float]] = []
    x = 0.0
    for column in columns.order:
        width = max((columns.items[i].width for i in column), default=0.0)
        extents.append((x, width))
        steep = (abs(centres[i] - centres[j]) for i in column for j in columns.items[i].after)
        x += width + min(MAX_COLUMN_GAP, MIN_COLUMN_GAP + max(steep, default=0.0) * 0.15)
    return extents
