"""The contact forces on some bodies, read from MuJoCo's solver in a few array operations.

In: model and data after each step. Out: one entry per contact and body: its position, and the force
on that body, split into the parts along the contact's normal and along the surface. Steps are only
recorded; the computation is deferred until many can be computed together, since small arrays cost
as much as large ones.
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
"""Contacts of one frame closer than about this are merged [m]."""

_TRUE = np.array([True])

_EDGES = np.arange(10)
"""Maximum number of edges of a contact's friction pyramid."""


@dataclass(frozen=True, slots=True, eq=False)
class LimbContacts:
    """k contacts: `limb` (k,), `points` (k, 3), `normal` force (k,) [N], force `along` (k, 3)."""

    limb: Ints
    points: Floats
    normal: Floats
    along: Floats


class ContactRecorder:
    """Records the contacts of each step, and computes the forces on limbs.

    `limb_of_geom` (geoms,) is -1 without skin; limb i has its frame on `bodies[i]`, at
    `origins[i]` (3,) with the axes `axes[i]` (3, 3) as columns.
    """

    def __init__(
        self, model: Any, limb_of_geom: Ints, bodies: Ints, origins: Floats, axes: Floats
    ) -> None:
        self._limb_of_geom, self._bodies = limb_of_geom, bodies
        self._origins, self._axes = origins, axes
        self._elliptic = model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
        self._written: list[tuple[Any, ...]] = []

    def record(self, data: Any) -> None:
        """Record the step that was just completed."""
        if not data.ncon:
            return
        found = data.contact
        self._written.append(
            (
                found.geom.copy(),
                found.pos.copy(),
                found.frame.copy(),
                found.efc_address.copy(),
                found.dim.copy(),
                found.friction.copy(),
                data.efc_force.copy(),
                data.xpos[self._bodies],
                data.xmat[self._bodies],
            )
        )

    def take(self) -> LimbContacts | None:
        """The contacts of all steps since the last call, in the frames of their limbs.

        None if there is no force on any limb. A contact between two limbs counts for both.
        """
        written, self._written = self._written, []
        if not written:
            return None
        counts = np.array([(len(batch[0]), len(batch[6])) for batch in written])
        geom, points, frame, address, dim, friction, solved, place, turn = (
            np.concatenate(blocks) for blocks in zip(*written, strict=True)
        )
        places, turns = self._limb_poses(place, turn)
        limb = self._limb_of_geom[geom]
        contact, side = np.nonzero((limb >= 0) & (address >= 0)[:, None])
        if not len(contact):
            return None
        when = np.repeat(np.arange(len(counts)), counts[:, 0])[contact]
        before = np.cumsum(counts[:, 1]) - counts[:, 1]
        first = address[contact] + before[when]
        normal, tangent = self._forces(solved, first, dim[contact], friction[contact, :2])
        frame = frame[contact]
        along = tangent[:, :1] * frame[:, 3:6] + tangent[:, 1:] * frame[:, 6:9]
        along *= np.where(side == 0, -1.0, 1.0)[:, None]  # the frame's force is on the second geom
        mine = limb[contact, side]
        pose = when * len(self._bodies) + mine
        turn = turns[pose]
        here = to_frames(points[contact] - places[pose], turn)
        pressing = normal > 0.0
        along = to_frames(along, turn)
        if pressing.all():
            return LimbContacts(mine, here, normal, along)
        if not pressing.any():
            return None  # the bodies have just touched, or are separating
        return LimbContacts(mine[pressing], here[pressing], normal[pressing], along[pressing])

    def _limb_poses(self, place: Floats, turn: Floats) -> tuple[Floats, Floats]:
        """Positions (s * l, 3) and rotations (s * l, 3, 3) of the l limb frames at all s steps."""
        turns = turn.reshape(-1, len(self._bodies), 3, 3)
        places = place.reshape(-1, len(self._bodies), 3)
        places = places + np.einsum("slij,lj->sli", turns, self._origins)
        turned = np.einsum("slij,ljk->slik", turns, self._axes)
        return places.reshape(-1, 3), turned.reshape(-1, 3, 3)

    def _forces(
        self, solved: Floats, first: Ints, dim: Ints, friction: Floats
    ) -> tuple[Floats, Floats]:
        """Normal force (k,) and the two forces along the surface (k, 2) of k contacts."""
        sliding = (dim >= 3)[:, None]
        if self._elliptic:
            local = solved[np.minimum(first[:, None] + _EDGES[:3], len(solved) - 1)]
            return local[:, 0], np.where(sliding, local[:, 1:], 0.0)
        # a pyramid has two edges for each of its dim - 1 directions: normal +- friction * direction
        edges = np.where(dim > 1, 2 * (dim - 1), 1)
        most = _EDGES[: int(edges.max())]
        local = solved[np.minimum(first[:, None] + most, len(solved) - 1)]
        local = np.where(most < edges[:, None], local, 0.0)
        tangent = np.zeros((len(dim), 2))
        if len(most) >= 4:
            tangent = np.where(sliding, (local[:, 0:4:2] - local[:, 1:4:2]) * friction, 0.0)
        return local.sum(axis=1), tangent


def to_frames(vectors: Floats, turns: Floats) -> Floats:
    """Vectors (k, 3) of the world in frames with rotations (k, 3, 3).

    Written out, since numpy multiplies many small matrices far slower.
    """
    x, y, z = vectors[:, :1], vectors[:, 1:2], vectors[:, 2:]
    turned: Floats = x * turns[:, 0] + y * turns[:, 1] + z * turns[:, 2]
    return turned


def merge(touch: LimbContacts) -> LimbContacts:
    """The contacts with those at nearly the same position merged.

    Forces are summed; the position is their mean, weighted by normal force.
    """
    grain = np.floor(touch.points * (1.0 / GRAIN)).astype(np.int64) + (1 << 15)
    key = ((touch.limb * (1 << 16) + grain[:, 0]) * (1 << 16) + grain[:, 1]) * (1 << 16)
    key += grain[:, 2]
    order = key.argsort(kind="stable")
    key = key[order]
    begins = np.flatnonzero(np.concatenate((_TRUE, key[1:] != key[:-1])))
    columns = np.empty((len(key), 7))
    columns[:, 0], columns[:, 4:] = touch.normal, touch.along
    np.multiply(touch.points, touch.normal[:, None], out=columns[:, 1:4])
    total = np.add.reduceat(columns[order], begins, axis=0)
    middle = total[:, 1:4] / total[:, :1]
    return LimbContacts(touch.limb[order[begins]], middle, total[:, 0], total[:, 4:])
