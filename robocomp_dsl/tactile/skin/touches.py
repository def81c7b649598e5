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
class Neighbours:
    """Pairs of taxels that may be one touch: `first[k]` and `second[k]`, of `size` taxels."""

    size: int
    first: Ints
    second: Ints

    def __deepcopy__(self, memo: object) -> Self:
        """It never changes: copies share it."""
        return self

    @classmethod
    def of(cls, points: Floats, limb: Ints | None = None, reach: float = REACH) -> Neighbours:
        """Neighbours among `points` (n, 3); only taxels with equal `limb` (n,) are related."""
        where = np.zeros(len(points), np.int64) if limb is None else limb
        first, second = [], []
        for one in np.unique(where):
            members = np.flatnonzero(where == one)
            i, j = _close(points[members], reach)
            first.append(members[i])
            second.append(members[j])
        empty = np.empty(0, np.int64)
        return cls(len(points), np.concatenate([empty, *first]), np.concatenate([empty, *second]))

    def touches(self, touched: Bools) -> list[Ints]:
        """The touched taxels (n,) as touches, each an ascending index array; lowest index first."""
        active = np.flatnonzero(touched)
        if not len(active):
            return []
        edge = touched[self.first] & touched[self.second]
        label = _components(self.size, self.first[edge], self.second[edge])[active]
        order = np.argsort(label, kind="stable")
        starts = np.flatnonzero(np.diff(label[order])) + 1
        return np.split(active[order], starts)


def _close(points: Floats, reach: float) -> tuple[Ints, Ints]:
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


def _components(size: int, first: Ints, second: Ints) -> Ints:
    """The lowest index that each of `size` nodes is connected with."""
    label = np.arange(size)
    while True:
        lowest = np.minimum(label[first], label[second])
        grown = label.copy()
        np.minimum.at(grown, first, lowest)
        np.minimum.at(grown, second, lowest)
        grown = grown[grown]
        if np.array_equal(grown, label):
            return label
        label = grown


def clusters(points: Floats, reach: float = REACH) -> list[Ints]:
    """Touches among `points` (n, 3) that are all touched."""
    return Neighbours.of(points, reach=reach).touches(np.ones(len(points), bool))
