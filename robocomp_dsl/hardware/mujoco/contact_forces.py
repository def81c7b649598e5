"""The contact forces on some bodies, read from MuJoCo's solver in a few array operations.

In: model and data after a step. Out: one entry per contact and body: where it is, and the force on
that body, split into the part along the contact's normal and the part along the surface.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GRAIN = 0.00025
"""Contacts of one frame nearer together than about this are taken as one [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """k contacts: `limb` (k,), `points` (k, 3), `normal` force (k,) [N], force `along` (k, 3)."""

    limb: Ints
    points: Floats
    normal: Floats
    along: Floats


def collect(model: Any, data: Any, limb_of_geom: Ints) -> Touch | None:
    """The contacts with geoms whose limb is not -1, in the frame of the world; None without any.

    A contact between two limbs counts on both.
    """
    found = data.contact
    limb = limb_of_geom[found.geom]
    side_by_side = (limb >= 0) & (found.efc_address >= 0)[:, None]
    contact, side = np.nonzero(side_by_side)
    if not len(contact):
        return None
    normal, tangent = _forces(model, data, contact)
    frame = found.frame[contact].reshape(-1, 3, 3)
    along = np.einsum("ni,nij->nj", tangent, frame[:, 1:])
    along *= np.where(side == 0, -1.0, 1.0)[:, None]  # the frame's force acts on the second geom
    pressing = normal > 0.0
    if not pressing.all():
        contact, side, normal = contact[pressing], side[pressing], normal[pressing]
        along = along[pressing]
    return Touch(limb[contact, side], found.pos[contact], normal, along)


def _forces(model: Any, data: Any, contact: Ints) -> tuple[Floats, Floats]:
    """Normal force (k,) and the two forces along the surface (k, 2) of `contact` (k,)."""
    found, solved = data.contact, data.efc_force
    first, dim = found.efc_address[contact], found.dim[contact]
    sliding = dim >= 3
    if model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC:
        rows = np.minimum(first[:, None] + np.arange(3), len(solved) - 1)
        local = solved[rows]
        return local[:, 0], np.where(sliding[:, None], local[:, 1:], 0.0)
    # a pyramid has two edges for each of its dim - 1 directions: normal +- friction * direction
    edges = np.where(dim > 1, 2 * (dim - 1), 1)
    rows = np.minimum(first[:, None] + np.arange(10), len(solved) - 1)
    local = np.where(np.arange(10) < edges[:, None], solved[rows], 0.0)
    pair = local[:, :4].reshape(-1, 2, 2)
    tangent = (pair[:, :, 0] - pair[:, :, 1]) * found.friction[contact, :2]
    return local.sum(axis=1), np.where(sliding[:, None], tangent, 0.0)


def merge(touches: list[Touch]) -> Touch:
    """The contacts of several steps as one list, those at nearly the same place as one.

    Forces are summed, so that nothing is lost; the place is their mean by normal force.
    """
    limb = np.concatenate([one.limb for one in touches])
    points = np.concatenate([one.points for one in touches])
    normal = np.concatenate([one.normal for one in touches])
    along = np.concatenate([one.along for one in touches])
    grain = np.floor(points / GRAIN).astype(np.int64) + (1 << 15)
    key = ((limb * (1 << 16) + grain[:, 0]) * (1 << 16) + grain[:, 1]) * (1 << 16) + grain[:, 2]
    _, first, group = np.unique(key, return_index=True, return_inverse=True)
    count = len(first)
    total = np.asarray(np.bincount(group, normal, count), dtype=np.float64)

    def summed(columns: Floats, weight: Floats | float = 1.0) -> Floats:
        weighed = columns * weight
        parts = [np.bincount(group, weighed[:, i], count) for i in range(3)]
        return np.stack(parts, axis=1)

    middle = summed(points, normal[:, None]) / total[:, None]
    return Touch(limb[first], middle, total, summed(along))
