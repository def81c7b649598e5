"""Distribute contact forces over taxels; the total force is preserved.

In: taxel positions once; contact points and forces. Out: force per taxel, and force off the skin.
Each force is shared by a Gaussian of the distance, cut off at three sigma, whose weights are
divided by their sum: the taxel forces add up to the force that reached the skin. Candidates
come from a grid of small cubes prepared beforehand.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from robocomp_dsl.tactile.arrays import Floats, Ints

SIGMA = 0.005
"""Width of the kernel [m]."""

CUTOFF = 3.0
"""Taxels further away than this many sigma receive no force."""

CELL = 0.005
"""Edge of the grid's cubes [m]; at least the width of the kernel."""


@dataclass(frozen=True, eq=False)
class ForceShare:
    """Forces of the taxels (n,) or (n, c), and the force off the skin, () or (c,)."""

    taxel_forces: Floats
    off_skin: Floats


class ForceKernel:
    """The skin of several limbs; points of different limbs are unrelated."""

    def __init__(self, points: Floats, limb: Ints, limbs: int, sigma: float = SIGMA) -> None:
        self._points, self._sigma = points, sigma
        self._reach = CUTOFF * sigma
        self._cell = max(CELL, sigma)
        self._low, self._shape = np.zeros((limbs, 3)), np.zeros((limbs, 3), np.int64)
        for index in range(limbs):
            mine = points[limb == index]
            if len(mine):
                self._low[index] = mine.min(axis=0) - self._reach
                extent = mine.max(axis=0) + self._reach - self._low[index]
                self._shape[index] = np.ceil(extent / self._cell).astype(np.int64) + 1
        self._first = np.concatenate(([0], np.cumsum(self._shape.prod(axis=1))))
        self._fill(limb)

    def __deepcopy__(self, memo: object) -> Self:
        """Immutable: copies share it."""
        return self

    def distribute(self, points: Floats, limb: Ints, forces: Floats) -> ForceShare:
        """Distribute `forces` (k,) or (k, c) that act at `points` (k, 3) of limbs `limb` (k,)."""
        contact, taxel, weight = self._pairs(points, limb)
        total = np.bincount(contact, weight, len(points))
        met = total > 0.0
        weight = weight / total[contact]
        columns = forces if forces.ndim == 2 else forces[:, None]
        felt = np.empty((len(self._points), columns.shape[1]))
        for i, column in enumerate(columns.T):
            felt[:, i] = np.bincount(taxel, weight * column[contact], len(self._points))
        missed = columns[~met].sum(axis=0)
        if forces.ndim == 1:
            return ForceShare(felt[:, 0], missed[0])
        return ForceShare(felt, missed)

    def _pairs(self, points: Floats, limb: Ints) -> tuple[Ints, Ints, Floats]:
        """Pairs of contact and taxel within reach, with their Gaussian weights."""
        cell = self._cells(points, limb)
        start, count = self._start[cell], self._start[cell + 1] - self._start[cell]
        contact = np.repeat(np.arange(len(points)), count)
        preceding = np.cumsum(count) - count
        taxel = self._taxels[np.arange(len(contact)) + np.repeat(start - preceding, count)]
        away = self._points[taxel] - points[contact]
        square = np.einsum("ij,ij->i", away, away)
        near = np.flatnonzero(square <= self._reach**2)
        weight = np.exp(square[near] * (-0.5 / self._sigma**2))
        return contact[near], taxel[near], weight

    def _cells(self, points: Floats, limb: Ints) -> Ints:
        """The occupied cube of each point; the last, empty one for points off the skin."""
        place = np.floor((points - self._low[limb]) * (1.0 / self._cell)).astype(np.int64)
        shape = self._shape[limb]
        inside = ((place >= 0) & (place < shape)).all(axis=1)
        x, y, z = place.T
        number = self._first[limb] + (x * shape[:, 1] + y) * shape[:, 2] + z
        cell = np.searchsorted(self._known, number)
        inside &= self._known[cell] == number
        return np.where(inside, cell, len(self._known) - 1)

    def _fill(self, limb: Ints) -> None:
        """Store for every cube the taxels within reach of any of its points."""
        far = self._reach + self._cell * np.sqrt(3.0) / 2.0
        steps = int(np.ceil(far / self._cell))
        axis = np.arange(-steps, steps + 1)
        offsets = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        cells, taxels = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        for block in np.array_split(np.arange(len(self._points)), len(self._points) // 512 + 1):
            low = self._low[limb[block]]
            home = np.floor((self._points[block] - low) / self._cell).astype(np.int64)
            place = home[:, None] + offsets
            middle = low[:, None] + (place + 0.5) * self._cell
            close = np.linalg.norm(middle - self._points[block][:, None], axis=2) <= far
            shape = self._shape[limb[block]][:, None]
            close &= ((place >= 0) & (place < shape)).all(axis=2)
            number = (place[..., 0] * shape[..., 1] + place[..., 1]) * shape[..., 2] + place[..., 2]
            number += self._first[limb[block]][:, None]
            cells.append(number[close])
            taxels.append(np.broadcast_to(block[:, None], close.shape)[close])
        cell, taxel = np.concatenate(cells), np.concatenate(taxels)
        order = np.argsort(cell, kind="stable")
        self._taxels = taxel[order]
        known, counts = np.unique(cell, return_counts=True)
        self._known = np.append(known, np.iinfo(np.int64).max)
        self._start = np.concatenate(([0], np.cumsum(np.append(counts, 0))))
