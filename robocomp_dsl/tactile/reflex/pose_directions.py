"""Directions of withdrawal from the current pose: away from the contact, through the Jacobian.

In: contacts on limbs, the pose, the limits of the arm, the kinematics of the robot. Out: a goal
that moves no contact point towards its touch, and keeps a distance to the rest of the robot. The
law replaces the direction of a field's motion (equation 6 of Ma and Dahl, 2016) by

    d = sum_i b_i a_i / |a_i|,   a_i = J_i(q)^T n_i,   subject to a_i . d >= 0 for all contacts i

with the inward normal n_i and the length b_i of the motion. Joints at a limit are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arm.limb_kinematics import LimbKinematics
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.reflex.withdrawal import ArmProperties, LimitCause

STEP = 0.05
"""Length of one integration step [rad]."""
WEAK = 0.005
"""A contact that moves less than this per joint angle cannot be avoided [m/rad]."""
AT_LIMIT = 0.005
"""A joint this close to a limit is at the limit [rad]."""
TOWARDS = 1e-5
"""Numerical tolerance of a motion towards a touch [m]."""
_FEWEST_SAMPLES = 8
_PROJECTIONS = 40
_SHORT = 0.3
_FEW = 0.2
_SLACK = 5e-4


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """A touch of `limb` at `point` (3,) [m]; `inward` (3,) is the unit normal into the limb.

    Both are in the frame of the limb. `length` is the length of the motion in joint space [rad].
    """

    limb: str
    point: Floats
    inward: Floats
    length: float


@dataclass(frozen=True, slots=True, eq=False)
class PlannedMotion:
    """A motion to `goal` (n,) [rad]; `progress` (m,) [m] is how far each contact moves away."""

    goal: Floats
    progress: Floats
    limit: LimitCause | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _Touched:
    """Contacts at the start of a motion: `inward` (m, 3) and `points` (m, 3) in the world."""

    contacts: Sequence[Contact]
    inward: Floats
    points: Floats


@dataclass(frozen=True, slots=True)
class PoseDirections:
    """Plans withdrawals with the kinematics of `body`; the arm keeps `margin` [m] to the robot."""

    body: LimbKinematics
    margin: float = 0.01

    def plan(self, pose: Floats, contacts: Sequence[Contact], arm: ArmProperties) -> PlannedMotion:
        """The motion from `pose` (n,) that withdraws from all `contacts`."""
        if not contacts:
            return PlannedMotion(pose, np.zeros(0))
        touched = self._touched(pose, contacts)
        direction, limited = self._direction(pose, touched, arm)
        length = float(np.linalg.norm(direction))
        if length == 0.0:
            nothing = LimitCause.JOINT_LIMITS if limited else LimitCause.NO_DIRECTION
            return PlannedMotion(pose, np.zeros(len(contacts)), nothing)
        path = self._integrate(pose, touched, arm, direction)
        goal = self._best_free_goal(pose, touched, (path, arm.within(pose + direction, pose)))
        shortened = np.linalg.norm(goal - pose) < _SHORT * np.linalg.norm(path - pose)
        cause = LimitCause.JOINT_LIMITS if limited else None
        if shortened:
            cause = LimitCause.OWN_BODY
            detours = self._single_joint_goals(pose, touched, arm, length)
            goal = self._best_free_goal(pose, touched, (goal, *detours))
        return PlannedMotion(goal, self._progress(goal, touched), cause)

    def free_part(self, pose: Floats, goal: Floats) -> Floats:
        """`goal` (n,), or the part of the straight way to it that keeps the margin."""
        reached = pose
        floor = self._floor(pose)
        for angles in _way(pose, goal):
            if self.body.clearance(angles, self.margin) < floor:
                return reached
            reached = angles
        return goal

    def is_free(self, pose: Floats, goal: Floats) -> bool:
        """Whether the straight way from `pose` (n,) to `goal` (n,) keeps the margin.

        Between them the arm may be as close to the robot as in the closer one of the two poses.
        """
        floor = min(self._floor(pose), self._floor(goal))
        return all(self.body.clearance(p, self.margin) >= floor for p in _way(pose, goal)[:-1])

    def _floor(self, pose: Floats) -> float:
        """The distance to keep: the margin, or that of `pose` if it is closer already."""
        return min(self.margin, self.body.clearance(pose, self.margin)) - _SLACK

    def _touched(self, pose: Floats, contacts: Sequence[Contact]) -> _Touched:
        frames = [self.body.frame(contact.limb, pose) for contact in contacts]
        pairs = list(zip(frames, contacts, strict=True))
        return _Touched(
            contacts,
            np.array([axes @ contact.inward for (_, axes), contact in pairs]),
            np.array([origin + axes @ contact.point for (origin, axes), contact in pairs]),
        )

    def _gradients(self, pose: Floats, touched: _Touched) -> Floats:
        """Speed away from each touch per joint speed, (m, n) [m/rad]."""
        return np.array(
            [
                inward @ self.body.jacobian(contact.limb, contact.point, pose)
                for contact, inward in zip(touched.contacts, touched.inward, strict=True)
            ]
        )

    def _direction(
        self, pose: Floats, touched: _Touched, arm: ArmProperties
    ) -> tuple[Floats, bool]:
        """The displacement (n,) at `pose`, and whether limits leave little of the gradient."""
        gradients = np.where(arm.available, self._gradients(pose, touched), 0.0)
        lengths = np.array([contact.length for contact in touched.contacts])
        free = arm.available.copy()
        direction = np.zeros(arm.size)
        for _ in range(arm.size + 1):
            direction = _away(np.where(free, gradients, 0.0), lengths)
            outward = free & _leaves_limits(pose, direction, arm)
            if not outward.any():
                break
            free &= ~outward
        before = np.linalg.norm(gradients, axis=1)
        after = np.linalg.norm(np.where(free, gradients, 0.0), axis=1)
        limited = bool(((before > WEAK) & (after < _FEW * before)).any())
        return direction, limited

    def _integrate(
        self, pose: Floats, touched: _Touched, arm: ArmProperties, direction: Floats
    ) -> Floats:
        """The end (n,) of the curve that follows the direction, as long as `direction`."""
        length = float(np.linalg.norm(direction))
        steps = max(round(length / STEP), 1)
        angles = pose
        for _ in range(steps):
            norm = float(np.linalg.norm(direction))
            if norm == 0.0:
                break
            angles = arm.within(angles + direction * (length / steps / norm), pose)
            direction, _ = self._direction(angles, touched, arm)
        return angles

    def _single_joint_goals(
        self, pose: Floats, touched: _Touched, arm: ArmProperties, length: float
    ) -> list[Floats]:
        """Goals that move one joint only, in the direction that leaves all touches."""
        gradients = self._gradients(pose, touched)
        goals = []
        for joint in np.flatnonzero(arm.available):
            speeds = gradients[:, joint]
            for sign in (1.0, -1.0):
                if (sign * speeds >= 0.0).all() and (sign * speeds > WEAK).any():
                    goal = pose.copy()
                    goal[joint] += sign * length
                    goals.append(arm.within(goal, pose))
        return goals

    def _best_free_goal(self, pose: Floats, touched: _Touched, goals: Sequence[Floats]) -> Floats:
        """The goal, shortened to what is free, that moves furthest away from the touches."""
        best, furthest = pose, 0.0
        floor = self._floor(pose)
        for goal in goals:
            free = self._withdrawing_part(pose, goal, touched, floor)
            away = float(self._progress(free, touched).sum())
            if away > furthest:
                best, furthest = free, away
        return best

    def _withdrawing_part(
        self, pose: Floats, goal: Floats, touched: _Touched, floor: float
    ) -> Floats:
        """The end of the part of the straight way to `goal` that is free."""
        reached, progress = pose, np.zeros(len(touched.contacts))
        for angles in _way(pose, goal):
            further = self._progress(angles, touched)
            if (further < progress - TOWARDS).any():
                break
            if self.body.clearance(angles, self.margin) < floor:
                break
            reached, progress = angles, further
        return reached

    def _progress(self, angles: Floats, touched: _Touched) -> Floats:
        """How far each contact point has moved along its inward normal, (m,) [m]."""
        points = []
        for contact in touched.contacts:
            origin, axes = self.body.frame(contact.limb, angles)
            points.append(origin + axes @ contact.point)
        progress: Floats = np.sum((np.array(points) - touched.points) * touched.inward, axis=1)
        return progress


def _way(pose: Floats, goal: Floats) -> Floats:
    """Poses (k, n) on the straight way in joint space, `goal` included."""
    count = max(_FEWEST_SAMPLES, int(np.ceil(np.linalg.norm(goal - pose) / STEP)))
    shares = np.linspace(0.0, 1.0, count + 1)[1:, None]
    way: Floats = pose + shares * (goal - pose)
    return way


def _away(gradients: Floats, lengths: Floats) -> Floats:
    """The displacement (n,) of the law for `gradients` (m, n); 0 if touches exclude each other."""
    norms = np.linalg.norm(gradients, axis=1)
    usable = norms > WEAK
    if not usable.any():
        return np.zeros(gradients.shape[1])
    units = gradients[usable] / norms[usable, None]
    direction: Floats = lengths[usable] @ units
    for _ in range(_PROJECTIONS):
        speeds = units @ direction
        worst = int(np.argmin(speeds))
        if speeds[worst] >= -1e-12:
            break
        direction = direction - speeds[worst] * units[worst]
    length = float(np.linalg.norm(direction))
    squeezed = length < 1e-6 or bool((units @ direction < -1e-3 * length).any())
    return np.zeros_like(direction) if squeezed else direction


def _leaves_limits(pose: Floats, direction: Floats, arm: ArmProperties) -> Bools:
    """The joints (n,) at a limit that `direction` would move beyond it."""
    low = (pose <= arm.low + AT_LIMIT) & (direction < 0.0)
    high = (pose >= arm.high - AT_LIMIT) & (direction > 0.0)
    leaving: Bools = low | high
    return leaving
