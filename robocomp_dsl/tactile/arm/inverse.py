"""Inverse kinematics by damped least squares, within joint limits.

In: a chain, limits, a wanted position and optionally a direction. Out: joint angles, or
`Unreachable` with how near the best ones come. Damping follows Levenberg and Marquardt; what the
task leaves free is used to stay near the start pose. No randomness: the same call gives the same
angles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arm.chain import Chain
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.errors import Unreachable

_STARTS = 16

STANDSTILL = 1e-4
"""A step that brings the pose nearer by less than this share is the last from its start."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """When a pose counts as reached: `position` [m], `rotation` [rad]; `iterations` per start."""

    position: float = 1e-4
    rotation: float = 1e-3
    iterations: int = 100


@dataclass(frozen=True, eq=False)
class Solver:
    """Inverse kinematics of `chain`; `low` and `high` (n,) bound its joints."""

    chain: Chain
    low: Floats
    high: Floats
    tolerance: Tolerance = Tolerance()

    def solve(
        self, position: Floats, start: Floats, rotation: Floats | None = None, weight: float = 0.1
    ) -> Floats:
        """Angles (n,) that bring the tool to `position` (3,), near `start`; else `Unreachable`.

        `rotation` (3, 3) is wanted too when given; `weight` [m/rad] says what a radian is worth
        against a metre while searching. Other start poses are tried when the first ends in a bend.
        """
        best: tuple[float, float, Floats] = (np.inf, np.inf, start)
        starts = self._starts(start)
        if self.chain.is_out_of_reach(position):
            starts = starts[:1]  # only how near it comes is of interest
        for first in starts:
            angles = self._descend(first, position, rotation, weight)
            distance, angle = self._missing(angles, position, rotation)
            if distance <= self.tolerance.position and angle <= self.tolerance.rotation:
                return angles
            if distance + weight * angle < best[0] + weight * best[1]:
                best = (distance, angle, angles)
        said = f"the nearest pose is {1000 * best[0]:.1f} mm and {best[1]:.3f} rad away"
        raise Unreachable(said, distance=best[0], angle=best[1])

    def _starts(self, start: Floats) -> list[Floats]:
        """The given pose, the middle of the limits, then poses spread evenly between them."""
        spread = np.outer(np.arange(1, _STARTS - 1), _golden(len(self.low))) % 1.0
        others = [self.low + (self.high - self.low) * share for share in spread]
        return [np.clip(start, self.low, self.high), (self.low + self.high) / 2, *others]

    def _descend(
        self, angles: Floats, position: Floats, rotation: Floats | None, weight: float
    ) -> Floats:
        damping, error, jacobian = 1e-2, *self._task(angles, position, rotation, weight)
        cost = float(error @ error)
        for _ in range(self.tolerance.iterations):
            trial = self._step(angles, jacobian, error, damping)
            found, turned = self._task(trial, position, rotation, weight)
            gained = cost - float(found @ found)
            if gained > 0.0:
                angles, error, jacobian = trial, found, turned
                cost, damping = cost - gained, max(damping * 0.25, 1e-7)
            else:
                damping *= 4.0
            if cost < (0.1 * self.tolerance.position) ** 2 or damping > 1e4:
                break
            if 0.0 < gained < STANDSTILL * cost:
                break
        return angles

    def _step(self, angles: Floats, jacobian: Floats, error: Floats, damping: float) -> Floats:
        """Where a step leads; joints that it brings to a limit stay there, the others make up."""
        free = self._free(angles, jacobian.T @ error)
        trial, left = angles, error
        while free.any():
            trial = np.where(free, angles + _damped_step(jacobian, left, damping, free), trial)
            within = np.clip(trial, self.low, self.high)
            beyond = free & (within != trial)
            trial, free = within, free & ~beyond
            if not beyond.any():
                break
            left = error - jacobian @ np.where(free, 0.0, trial - angles)
        return trial

    def _free(self, angles: Floats, pull: Floats) -> Bools:
        """Joints that are not held at a limit by the way they are pulled."""
        free: Bools = ~(((angles <= self.low) & (pull < 0)) | ((angles >= self.high) & (pull > 0)))
        return free

    def _task(
        self, angles: Floats, position: Floats, rotation: Floats | None, weight: float
    ) -> tuple[Floats, Floats]:
        """What is missing (3 or 6,) and how the joints change it."""
        pose, jacobian = self.chain.reach(angles)
        away = position - pose[:3, 3]
        if rotation is None:
            return away, jacobian[:3]
        turn = weight * rotation_vector(rotation @ pose[:3, :3].T)
        return np.concatenate((away, turn)), np.vstack((jacobian[:3], weight * jacobian[3:]))

    def _missing(
        self, angles: Floats, position: Floats, rotation: Floats | None
    ) -> tuple[float, float]:
        pose = self.chain.pose(angles)
        distance = float(np.linalg.norm(position - pose[:3, 3]))
        if rotation is None:
            return distance, 0.0
        return distance, float(np.linalg.norm(rotation_vector(rotation @ pose[:3, :3].T)))


def _damped_step(jacobian: Floats, error: Floats, damping: float, free: Bools) -> Floats:
    """Least-squares step of the free joints, shortened by `damping` relative to the task."""
    used = np.where(free, jacobian, 0.0)
    square = used @ used.T
    scale = damping * max(float(np.trace(square)), 1e-9)
    step: Floats = used.T @ np.linalg.solve(square + scale * np.eye(len(error)), error)
    return step


def rotation_vector(rotation: Floats) -> Floats:
    """Axis times angle [rad] of a rotation matrix, angle in [0, pi]."""
    twice = np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    sine, cosine = float(np.linalg.norm(twice)) / 2, (float(np.trace(rotation)) - 1) / 2
    angle = np.arctan2(sine, cosine)
    if sine > 1e-6:
        return np.asarray(twice * (angle / (2 * sine)))
    if cosine > 0:
        return twice / 2
    # a half turn: rotation + 1 = 2 axis axis^T, so its largest row is along the axis
    square = rotation + np.eye(3)
    axis = square[int(np.argmax(np.diag(square)))]
    return np.asarray(axis / np.linalg.norm(axis) * angle)


def _golden(size: int) -> Floats:
    """Steps whose multiples fill the unit cube evenly (roots of x^(n+1) = x + 1)."""
    root = 2.0
    for _ in range(30):
        root = (1 + root) ** (1 / (size + 1))
    return np.asarray(root ** -np.arange(1.0, size + 1))
