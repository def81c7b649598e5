"""Denavit-Hartenberg chains: forward kinematics and Jacobians.

In: rows (a, d, alpha, offset) of the form Rz(q + offset) Tz(d) Tx(a) Rx(alpha), a base and a tool.
Out: 4 x 4 poses in the frame of the base, and Jacobians (6, n): three rows of velocity [m/s per
rad/s], three of rotation. Metres and radians.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class DhLink:
    """One link. `joint` is the index of its joint, or None for a link fixed at `offset`."""

    a: float
    d: float
    alpha: float
    offset: float
    joint: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _FixedTransforms:
    """A chain with fixed transforms multiplied: `before` (4, 4), then one entry per moving row.

    `joints` (m,) and `offsets` (m,) rotate it, `behind` (m, 4, 4) leads to the next row.
    """

    joints: Ints
    offsets: Floats
    before: Floats
    behind: Floats


@dataclass(frozen=True, eq=False)
class Chain:
    """Rows from `base` to `tool` (both 4 x 4), moved by `size` joints."""

    rows: tuple[DhLink, ...]
    size: int
    base: Floats = field(default_factory=lambda: np.eye(4))
    tool: Floats = field(default_factory=lambda: np.eye(4))

    def __post_init__(self) -> None:
        used = [row.joint for row in self.rows if row.joint is not None]
        if len(set(used)) != len(used) or not all(0 <= joint < self.size for joint in used):
            raise ValueError(f"each joint index lies in 0..{self.size - 1} and occurs at most once")

    def pose(self, angles: Floats) -> Floats:
        """Pose of the tool, 4 x 4, for angles (n,)."""
        last: Floats = self._frames(angles)[-1]
        return last

    def jacobian(self, angles: Floats) -> Floats:
        """Velocity and rotation of the tool per joint speed, (6, n); zero for unused joints."""
        return self.pose_and_jacobian(angles)[1]

    def pose_and_jacobian(self, angles: Floats) -> tuple[Floats, Floats]:
        """Pose of the tool and Jacobian, computed together."""
        frames, used = self._frames(angles), self._steps.joints
        x, y, z = frames[:-1, :3, 2].T
        along, up, out = (frames[-1, :3, 3] - frames[:-1, :3, 3]).T
        jacobian = np.zeros((6, self.size))
        # the axis of each joint, crossed with the vector from it to the tool
        jacobian[:3, used] = (y * out - z * up, z * along - x * out, x * up - y * along)
        jacobian[3:, used] = x, y, z
        return frames[-1], jacobian

    def is_out_of_reach(self, point: Floats) -> bool:
        """Whether `point` (3,) is out of reach even with all links stretched out."""
        steps = self._steps
        longest = float(np.linalg.norm(steps.behind[:, :3, 3], axis=1).sum())
        return float(np.linalg.norm(point - steps.before[:3, 3])) > longest

    def _frames(self, angles: Floats) -> Floats:
        """Poses of the starts of the moving rows, and of the tool."""
        steps = self._steps
        turns = angles[steps.joints] + steps.offsets
        c, s = np.cos(turns)[:, None], np.sin(turns)[:, None]
        behind = steps.behind.copy()
        behind[:, 0] = c * steps.behind[:, 0] - s * steps.behind[:, 1]
        behind[:, 1] = s * steps.behind[:, 0] + c * steps.behind[:, 1]
        poses = np.empty((len(turns) + 1, 4, 4))
        poses[0] = steps.before
        for i, matrix in enumerate(behind):
            np.matmul(poses[i], matrix, out=poses[i + 1])
        return poses

    @cached_property
    def _steps(self) -> _FixedTransforms:
        """Values that are independent of the angles, computed once."""
        before, behind = self.base, list[Floats]()
        for row in self.rows:
            matrix = link(row.a, row.d, row.alpha, row.offset if row.joint is None else 0.0)
            if row.joint is not None:
                behind.append(matrix)
            elif behind:
                behind[-1] = behind[-1] @ matrix
            else:
                before = before @ matrix
        if behind:
            behind[-1] = behind[-1] @ self.tool
        else:
            before = before @ self.tool
        moving = [row for row in self.rows if row.joint is not None]
        return _FixedTransforms(
            joints=np.array([row.joint for row in moving], np.int64),
            offsets=np.array([row.offset for row in moving]),
            before=before,
            behind=np.array(behind).reshape(-1, 4, 4),
        )


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

    A negative gamma reverses the joint's axis: the required half turn about x is added to the twist
    of the previous row and to the row itself. A joint that the device lacks stays fixed at its
    row's offset, since its generic angle is always sigma.
    """
    if not np.allclose(np.abs(gamma), 1.0):
        raise ValueError("a generic chain needs |gamma| = 1: device angles in radians")
    rows: list[DhLink] = []
    base = chain.base
    for row in chain.rows:
        if row.joint is None or not available[row.joint]:
            rows.append(DhLink(row.a, row.d, row.alpha, row.offset))
        elif gamma[row.joint] > 0:
            offset = row.offset - float(sigma[row.joint])
            rows.append(DhLink(row.a, row.d, row.alpha, offset, row.joint))
        else:
            base = _half_turn(rows, base)
            # Rz(c - g) = Rx(pi) Rz(g - c) Rx(pi): z lengths change sign, x lengths do not
            offset = -row.offset - float(sigma[row.joint])
            rows.append(DhLink(row.a, -row.d, row.alpha + np.pi, offset, row.joint))
    return Chain(tuple(rows), chain.size, base, chain.tool)


def _half_turn(rows: list[DhLink], base: Floats) -> Floats:
    """Append a half turn about x to the last row, or to the base; returns the base."""
    if not rows:
        return base @ link(0.0, 0.0, np.pi, 0.0)
    last = rows[-1]
    rows[-1] = DhLink(last.a, last.d, last.alpha + np.pi, last.offset, last.joint)
    return base
