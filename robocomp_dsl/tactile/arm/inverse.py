"""Inverse kinematics by damped least squares, within joint limits: the solver of all arms.

In: a chain, joint limits, a goal (a position, optionally with an orientation) and a start posture.
Out: joint angles, and the remaining error of the tip.

The damping is proportional to the squared error (Sugihara, "Solvability-unconcerned inverse
kinematics by the Levenberg-Marquardt method", IEEE Trans. Robotics 27(5), 2011). The solver is
deterministic: the same call gives the same angles. Lengths are in the unit of the chain.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import Unreachable

_STARTS = 16
_LEAST_DAMPING = 1e-6
_WEAK = 0.01
"""A joint motion that moves the tip by less, per rad, in units of `lever`, counts as null space."""

_PULL = 0.1
"""Share of the distance to the rest posture that the first step covers."""

STANDSTILL = 1e-4
"""A descent ends when a step reduces the squared error by less than this share."""


class Kinematics(Protocol):
    """Forward kinematics of a chain with n joints."""

    def pose_and_jacobian(self, angles: Floats) -> tuple[Floats, Floats]:
        """Pose of the tip (4, 4) at `angles` (n,), and the Jacobian (6, n), rotation below."""

    def is_out_of_reach(self, point: Floats) -> bool:
        """Whether `point` (3,) is out of reach even with all links stretched out."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Tolerance of a goal: `position` [length], `rotation` [rad].

    `iterations` limits the steps from each start posture.
    """

    position: float = 1e-4
    rotation: float = 1e-3
    iterations: int = 150


@dataclass(frozen=True, eq=False, slots=True)
class Goal:
    """A position (3,) [length] and, unless None, an orientation (3, 3)."""

    position: Floats
    orientation: Floats | None = None

    def error(self, pose: Floats, lever: float) -> Floats:
        """Error of `pose` (4, 4): position in units of `lever`, rotation in rad; (6,) or (3,)."""
        distance: Floats = (self.position - pose[:3, 3]) / lever
        if self.orientation is None:
            return distance
        return np.concatenate((distance, rotation_vector(self.orientation @ pose[:3, :3].T)))


@dataclass(frozen=True, eq=False, slots=True)
class Solution:
    """Joint angles `q` (n,), and the remaining error of the tip [length, rad]."""

    q: Floats
    distance: float
    angle: float

    def within(self, distance: float, angle: float) -> bool:
        """Whether the goal is reached within `distance` [length] and `angle` [rad]."""
        return self.distance <= distance and self.angle <= angle


@dataclass(frozen=True, eq=False)
class Solver:
    """Inverse kinematics of `chain`; `low` and `high` (n,) [rad] bound its joints.

    An error of 1 rad counts as much as one of `lever` [length]. In the null space of the goal the
    joints move towards the posture `rest` (n,); without it they stay near the start.
    """

    chain: Kinematics
    low: Floats
    high: Floats
    tolerance: Tolerance = Tolerance()
    lever: float = 0.1
    rest: Floats | None = None

    def solve(self, position: Floats, start: Floats, orientation: Floats | None = None) -> Floats:
        """Angles (n,) for a position (3,) and optionally an orientation (3, 3), near `start`.

        Raises `Unreachable` with the remaining distance and angle.
        """
        best = self.nearest(Goal(position, orientation), start)
        if best.within(self.tolerance.position, self.tolerance.rotation):
            return best.q
        message = f"the nearest pose is {1000 * best.distance:.1f} mm and {best.angle:.3f} rad away"
        raise Unreachable(message, distance=best.distance, angle=best.angle)

    def nearest(self, goal: Goal, start: Floats) -> Solution:
        """The first solution within the tolerance, or else the best one.

        Other start postures are tried if the descent from `start` ends in a local minimum.
        """
        starts = self._starts(start)
        if self.chain.is_out_of_reach(goal.position):
            starts = starts[:1]  # only the remaining error matters
        best: Solution | None = None
        for first in starts:
            solution = self._descend(goal, first)
            if solution.within(self.tolerance.position, self.tolerance.rotation):
                return solution
            if best is None or self._cost(solution) < self._cost(best):
                best = solution
        assert best is not None  # noqa: S101 - there is always a first start
        return best

    def _starts(self, start: Floats) -> list[Floats]:
        """`start`, the rest posture or the middle of the limits, then postures spread evenly."""
        spread = np.outer(np.arange(1, _STARTS - 1), _golden_steps(len(self.low))) % 1.0
        others = [self.low + (self.high - self.low) * share for share in spread]
        rest = (self.low + self.high) / 2 if self.rest is None else self.rest
        return [np.clip(first, self.low, self.high) for first in (start, rest, *others)]

    def _descend(self, goal: Goal, q: Floats) -> Solution:
        best, last = self._solution(np.full(6, np.inf), q), np.inf
        for k in range(self.tolerance.iterations):
            pose, jacobian = self.chain.pose_and_jacobian(q)
            error = goal.error(pose, self.lever)
            solution = self._solution(error, q)
            if self._cost(solution) < self._cost(best):
                best = solution
            squared = float(error @ error)
            close = 0.1 * self.tolerance.position, 0.1 * self.tolerance.rotation
            if best.within(*close) or 0.0 <= last - squared < STANDSTILL * squared:
                break
            q = q + self._step(jacobian, q, error, k)
            last = squared
        return best

    def _step(self, jacobian: Floats, q: Floats, error: Floats, k: int) -> Floats:
        matrix = jacobian[: len(error)].copy()
        matrix[:3] /= self.lever
        pull = np.zeros(len(q))
        if self.rest is not None:  # it fades, so that the end is exact
            pull = _PULL * (1.0 - k / self.tolerance.iterations) * (self.rest - q)
        damping = 0.5 * float(error @ error) + _LEAST_DAMPING
        return damped_step(matrix, error, pull, damping, (self.low - q, self.high - q))

    def _solution(self, error: Floats, q: Floats) -> Solution:
        distance = float(np.linalg.norm(error[:3])) * self.lever
        return Solution(q, distance, float(np.linalg.norm(error[3:])))

    def _cost(self, solution: Solution) -> float:
        return float(np.hypot(solution.distance / self.lever, solution.angle))


def damped_step(
    jacobian: Floats, error: Floats, pull: Floats, damping: float, limits: tuple[Floats, Floats]
) -> Floats:
    """One step of damped least squares, (n,), that reduces `error` (m,) by `jacobian` (m, n).

    `pull` (n,) moves the joints within the null space of `error`. A joint that would pass one of
    its `limits`, the lowest and the highest step (n,), moves to the limit, and the other joints
    compensate.
    """
    low, high = limits
    clipped, free = np.zeros(len(pull)), np.ones(len(pull), bool)
    while free.any():
        left, strength, right = np.linalg.svd(jacobian * free, full_matrices=False)
        gain = strength / (strength * strength + damping)
        bound = right[strength > _WEAK]
        pulled = pull * free
        step = clipped + right.T @ (gain * (left.T @ (error - jacobian @ clipped)))
        step += pulled - bound.T @ (bound @ pulled)
        past = free & ((step > high) | (step < low))
        if not past.any():
            return np.where(free, step, clipped)
        clipped = np.where(past, np.clip(step, low, high), clipped)
        free &= ~past
    return clipped


def rotation_vector(rotation: Floats) -> Floats:
    """Axis times angle [rad] of a rotation matrix (3, 3); the angle is in [0, pi]."""
    skew = rotation - rotation.T
    vector = 0.5 * np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    sine, cosine = float(np.linalg.norm(vector)), (float(np.trace(rotation)) - 1.0) / 2.0
    if sine > 1e-8:
        return np.asarray(vector * (np.arctan2(sine, cosine) / sine))
    if cosine > 0.0:
        return vector
    # a half turn: rotation + 1 = 2 axis axis^T, so its largest column is along the axis
    columns = rotation + np.eye(3)
    axis = columns[:, int(np.argmax(np.linalg.norm(columns, axis=0)))]
    return np.asarray(axis * (np.pi / np.linalg.norm(axis)))


def _golden_steps(size: int) -> Floats:
    """Steps whose multiples fill the unit cube evenly (roots of x^(n+1) = x + 1)."""
    root = 2.0
    for _ in range(30):
        root = (1 + root) ** (1 / (size + 1))
    return np.asarray(root ** -np.arange(1.0, size + 1))
