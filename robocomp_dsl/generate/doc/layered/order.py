"""Minimise crossings: order each column by the positions of its items' neighbours.

In: columns. Out: the same, ordered by barycentres (Sugiyama, Tagawa and Toda 1981), columns swept
forth and back; the best order is used.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.doc.layered.columns import Columns

SWEEPS = 16
MAX_IDLE_SWEEPS = 5
"""Stop after this many sweeps without improvement."""


def minimize_crossings(columns: Columns) -> None:
    """Change the order of the items in each column."""
    best, fewest, idle = [list(column) for column in columns.order], count_crossings(columns), 0
    for sweep in range(SWEEPS):
        if not fewest or idle > MAX_IDLE_SWEEPS:
            break
        _sweep(columns, forth=sweep % 2 == 0)
        count = count_crossings(columns)
        idle += 1
        if count < fewest:
            best, fewest, idle = [list(column) for column in columns.order], count, 0
    columns.order[:] = best


def _sweep(columns: Columns, *, forth: bool) -> None:
    place: dict[int, float] = {}
    order = columns.order
    for column in range(len(order)) if forth else reversed(range(len(order))):
        barycentres = {}
        for i, index in enumerate(order[column]):
            item = columns.items[index]
            beside = item.before if forth else item.after
            own = (i + 0.5) / len(order[column])
            barycentres[index] = sum(place[b] for b in beside) / len(beside) if beside else own
        order[column].sort(key=barycentres.__getitem__)
        place |= {index: (i + 0.5) / len(order[column]) for i, index in enumerate(order[column])}


def count_crossings(columns: Columns) -> int:
    """The number of line crossings."""
    total = 0
    for left, right in zip(columns.order, columns.order[1:], strict=False):
        place = {index: i for i, index in enumerate(right)}
        ends: list[int] = []
        for index in left:
            ends += sorted([place[after] for after in columns.items[index].after])
        total += _inversions(ends, len(right))
    return total


def _inversions(numbers: Sequence[int], limit: int) -> int:
    """Pairs in the wrong order, counted with a binary indexed tree."""
    tree = [0] * (limit + 1)
    total = 0
    for seen, number in enumerate(numbers):
        position, smaller = number + 1, 0
        while position:
            smaller += tree[position]
            position &= position - 1
        total += seen - smaller
        position = number + 1
        while position <= limit:
            tree[position] += 1
            position += position & -position
    return total
