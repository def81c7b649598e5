"""Group touched taxels into touches.

In: taxel positions once, forces every frame. Out: one index array per touch. Taxels at most
`reach` apart, on the same limb and both touched, belong to one touch: the connected components
that iCub's skin manager looks for.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats, Ints

REACH = 0.015
"""Largest distance between neighbours of one touch [m]."""


@dataclass(frozen=True, eq=False)
class TaxelGraph:
    """Neighbours that may share a touch: those of taxel i are `near[start[i] : start[i + 1]]`."""

    start: Ints
    near: Ints

    def __deepcopy__(self, memo: object) -> Self:
        """Immutable: copies share it."""
        return self

    @classmethod
    def of(cls, points: Floats, limb: Ints | None = None, reach: float = REACH) -> TaxelGraph:
        """Neighbours among `points` (n, 3); only taxels with equal `limb` (n,) are related."""
        where = np.zeros(len(points), np.int64) if limb is None else limb
        left, right = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        for name in np.unique(where):
            members = np.flatnonzero(where == name)
            i, j = _close_pairs(points[members], reach)
            left += [members[i], members[j]]
            right += [members[j], members[i]]
        first, second = np.concatenate(left), np.concatenate(right)
        counts = np.bincount(first, minlength=len(points))
        start = np.concatenate(([0], np.cumsum(counts)))
        return cls(start, second[np.argsort(first, kind="stable")])

    def labels(self, active: Ints) -> Ints:
        """For each of the taxels `active` (k,), ascending, the number of its touch, from 0.

        Touches are numbered by their lowest taxel.
        """
        place = np.full(len(self.start) - 1, -1)
        place[active] = np.arange(len(active))
        begin, count = self.start[active], self.start[active + 1] - self.start[active]
        offset = np.repeat(begin - (np.cumsum(count) - count), count)
        second = place[self.near[np.arange(len(offset)) + offset]]
        there = second >= 0
        first = np.repeat(np.arange(len(active)), count)[there]
        lowest = _components(np.bincount(first, minlength=len(active)), second[there])
        roots = np.zeros(len(active), np.int64)
        roots[lowest] = 1
        return (np.cumsum(roots) - 1)[lowest]

    def touches(self, touched: Bools) -> list[Ints]:
        """The touched taxels (n,) as touches, each an ascending index array; lowest index first."""
        active = np.flatnonzero(touched)
        if not len(active):
            return []
        label = self.labels(active)
        order = np.argsort(label, kind="stable")
        starts = np.flatnonzero(np.diff(label[order])) + 1
        return np.split(active[order], starts)


def _close_pairs(points: Floats, reach: float) -> tuple[Ints, Ints]:
    """Index pairs i < j at most `reach` apart, row block by row block to bound the memory."""
    first, second = [], []
    for start in range(0, len(points), 256):
        block = points[start : start + 256]
        square = np.sum((block[:, None] - points[None]) ** 2, axis=2)
        i, j = np.nonzero(square <= reach**2 * (1 + 1e-12))
        keep = i + start < j
        first.append(i[keep] + start)
        second.append(j[keep])
    empty = np.empty(0, np.int64)
    return np.concatenate([empty, *first]), np.concatenate([empty, *second])


def _components(count: Ints, near: Ints) -> Ints:
    """The lowest index connected with each node; `near` lists `count` neighbours of each."""
    label = np.arange(len(count))
    lonely = count == 0
    begin = np.cumsum(count)[~lonely] - count[~lonely]
    while len(near):
        grown = label.copy()
        grown[~lonely] = np.minimum(label[~lonely], np.minimum.reduceat(label[near], begin))
        np.minimum.at(grown, label, grown)  # propagate labels to the lowest node of each group
        grown = grown[grown]
        if np.array_equal(grown, label):
            break
        label = grown
    return label


def clusters(points: Floats, reach: float = REACH) -> list[Ints]:
    """The touches of `points` (n, 3), all of which are touched."""
    return TaxelGraph.of(points, reach=reach).touches(np.ones(len(points), bool))
