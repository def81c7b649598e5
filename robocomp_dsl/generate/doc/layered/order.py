"""The order in each column, so that few lines cross: each item goes where its neighbours are.

In: columns. Out: the same, ordered by barycentres (Sugiyama, Tagawa and Toda 1981), columns swept
forth and back; the best order met is kept.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.generate.doc.layered.columns import Columns

SWEEPS = 16
PATIENCE = 5
"""Sweeps without a better order, after which there is none to be hoped for."""


def put_in_order(columns: Columns) -> None:
    """Change the order of the items in each column."""
    best, fewest, waited = [list(one) for one in columns.order], crossings(columns), 0
    for sweep in range(SWEEPS):
        if not fewest or waited > PATIENCE:
            break
        _sweep(columns, forth=sweep % 2 == 0)
        found = crossings(columns)
        waited += 1
        if found < fewest:
            best, fewest, waited = [list(one) for one in columns.order], found, 0
    columns.order[:] = best


def _sweep(columns: Columns, *, forth: bool) -> None:
    place: dict[int, float] = {}
    order = columns.order
    for at in range(len(order)) if forth else reversed(range(len(order))):
        wanted = {}
        for i, one in enumerate(order[at]):
            item = columns.items[one]
            beside = item.before if forth else item.after
            own = (i + 0.5) / len(order[at])
            wanted[one] = sum(place[b] for b in beside) / len(beside) if beside else own
        order[at].sort(key=wanted.__getitem__)
        place |= {one: (i + 0.5) / len(order[at]) for i, one in enumerate(order[at])}


def crossings(columns: Columns) -> int:
    """How often two lines cross."""
    total = 0
    for left, right in zip(columns.order, columns.order[1:], strict=False):
        place = {one: i for i, one in enumerate(right)}
        ends: list[int] = []
        for one in left:
            ends += sorted([place[after] for after in columns.items[one].after])
        total += _inversions(ends, len(right))
    return total


def _inversions(numbers: Sequence[int], limit: int) -> int:
    """Pairs in the wrong order, counted with a binary indexed tree."""
    tree = [0] * (limit + 1)
    total = 0
    for seen, number in enumerate(numbers):
        at, smaller = number + 1, 0
        while at:
            smaller += tree[at]
            at &= at - 1
        total += seen - smaller
        at = number + 1
        while at <= limit:
            tree[at] += 1
            at += at & -at
    return total
