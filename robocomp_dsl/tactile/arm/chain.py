"""Denavit-Hartenberg chains: where the joints put the hand, and how it moves with them.

In: rows (a, d, alpha, offset) of the form Rz(q + offset) Tz(d) Tx(a) Rx(alpha), a base and a tool.
Out: 4 x 4 poses in the frame of the base, and Jacobians (6, n): three rows of velocity [m/s per
rad/s], three of rotation. Metres and radians.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats


@dataclass(frozen=True, slots=True)
class Row:
    """One link. `joint` is the index of its joint, or None for a link fixed at `offset`."""

    a: float
    d: float
    alpha: float
    offset: float
    joint: int | None = None


@dataclass(frozen=True, eq=False)
class Chain:
    """Rows from `base` to `tool` (both 4 x 4), moved by `size` joints."""

    rows: tuple[Row, ...]
    size: int
    base: Floats = field(default_factory=lambda: np.eye(4))
    tool: Floats = field(default_factory=lambda: np.eye(4))

    def __post_init__(self) -> None:
        used = [row.joint for row in self.rows if row.joint is not None]
        if len(set(used)) != len(used) or not all(0 <= joint < self.size for joint in used):
            raise ValueError(f"each joint index lies in 0..{self.size - 1} and occurs at most once")

    def frames(self, angles: Floats) -> Floats:
        """Pose before each row and of the tool last, shape (rows + 1, 4, 4), for angles (n,)."""
        poses = np.empty((len(self.rows) + 1, 4, 4))
        pose = self.base
        for i, row in enumerate(self.rows):
            poses[i] = pose
            turn = row.offset + (angles[row.joint] if row.joint is not None else 0.0)
            pose = pose @ link(row.a, row.d, row.alpha, float(turn))
        poses[-1] = pose @ self.tool
        return poses

    def pose(self, angles: Floats) -> Floats:
        """Pose of the tool, 4 x 4."""
        last: Floats = self.frames(angles)[-1]
        return last

    def jacobian(self, angles: Floats) -> Floats:
        """Velocity and rotation of the tool per joint speed, (6, n); zero for unused joints."""
        return self.jacobian_of(self.frames(angles))

    def jacobian_of(self, frames: Floats) -> Floats:
        """The Jacobian where the frames are known already."""
        jacobian = np.zeros((6, self.size))
        tool = frames[-1, :3, 3]
        for i, row in enumerate(self.rows):
            if row.joint is not None:
                axis = frames[i, :3, 2]
                jacobian[:3, row.joint] = _cross(axis, tool - frames[i, :3, 3])
                jacobian[3:, row.joint] = axis
        return jacobian


def link(a: float, d: float, alpha: float, turn: float) -> Floats:
    """Rz(turn) Tz(d) Tx(a) Rx(alpha) as one 4 x 4 matrix."""
    ct, st, ca, sa = np.cos(turn), np.sin(turn), np.cos(alpha), np.sin(alpha)
    return np.array(
        [
            [ct, -st * ca, st * sa, a * ct],
            [st, ct * ca, -ct * sa, a * st],
            [0.0, sa, ca, d],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def generic_chain(chain: Chain, gamma: Floats, sigma: Floats, available: Bools) -> Chain:
    """The same arm, driven by generic angles: device = (generic - sigma) / gamma, |gamma| = 1.

    A negative gamma turns the joint's axis round: the half turn about x that this takes is put
    into the twist of the row before and into the row itself. A joint that the device lacks stays
    fixed at its row's offset, since its generic angle is always sigma.
    """
    if not np.allclose(np.abs(gamma), 1.0):
        raise ValueError("a generic chain needs |gamma| = 1: device angles in radians")
    rows: list[Row] = []
    base = chain.base
    for row in chain.rows:
        if row.joint is None or not available[row.joint]:
            rows.append(Row(row.a, row.d, row.alpha, row.offset))
        elif gamma[row.joint] > 0:
            offset = row.offset - float(sigma[row.joint])
            rows.append(Row(row.a, row.d, row.alpha, offset, row.joint))
        else:
            base = _half_turn(rows, base)
            # Rz(c - g) = Rx(pi) Rz(g - c) Rx(pi): z lengths change sign, x lengths do not
            offset = -row.offset - float(sigma[row.joint])
            rows.append(Row(row.a, -row.d, row.alpha + np.pi, offset, row.joint))
    return Chain(tuple(rows), chain.size, base, chain.tool)


def _half_turn(rows: list[Row], base: Floats) -> Floats:
    """Put a half turn about x behind the last row, or behind the base; returns the base."""
    if not rows:
        return base @ link(0.0, 0.0, np.pi, 0.0)
    last = rows[-1]
    rows[-1] = Row(last.a, last.d, last.alpha + np.pi, last.offset, last.joint)
    return base


def _cross(one: Floats, other: Floats) -> Floats:
    """The cross product of two vectors; numpy's is ten times slower for a single pair."""
    (a, b, c), (x, y, z) = one, other
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])
