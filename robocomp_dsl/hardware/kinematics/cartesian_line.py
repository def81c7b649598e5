"""The path of an end effector between two poses: a straight line, at rest at both ends.

In: both ends, as poses and as postures. Out: the goal and the posture at each time, by minimum
jerk.
"""

from __future__ import annotations

import math

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.tactile.arm.inverse import Goal, rotation_vector


class LineMotion:
    """From one pose and posture to another, at rest at both ends; `time` is the elapsed time."""

    def __init__(
        self, pose: Matrix, start: Floats, goal: Goal, end: Floats, seconds: float
    ) -> None:
        self._from, self._goal = pose, goal
        self._way = goal.position - pose[:3, 3]
        self._turn = None
        if goal.orientation is not None:
            self._turn = rotation_vector(goal.orientation @ pose[:3, :3].T)
        self.start, self.end, self.seconds, self.time = start, end, seconds, 0.0

    def goal_at(self, time: float) -> tuple[Goal, Floats]:
        """The goal and the posture at `time`; minimum jerk from rest to rest."""
        t = time / self.seconds
        share = t**3 * (10.0 - 15.0 * t + 6.0 * t * t)
        posture = self.start + share * (self.end - self.start)
        place = self._from[:3, 3] + share * self._way
        if self._turn is None:
            return Goal(place), posture
        return Goal(place, rotation_about(share * self._turn) @ self._from[:3, :3]), posture


def rotation_about(vector: Floats) -> Matrix:
    """The rotation about `vector` by its length (Rodrigues' formula), shape (3, 3)."""
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    rotation: Matrix = (
        np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
    )
    return rotation
