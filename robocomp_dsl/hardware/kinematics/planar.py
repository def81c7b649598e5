"""Poses on the floor and their change by wheels: pure functions, no device.

In: poses, and distances travelled by wheels. Out: poses. The heading `alpha` grows from z
towards x, so ahead is (sin alpha, cos alpha) and a right turn is positive.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Pose:
    """A position on the floor: `x` and `z` in mm, and the heading `alpha` in rad."""

    x: float = 0.0
    z: float = 0.0
    alpha: float = 0.0

    def then(self, step: Pose) -> Pose:
        """The pose after a `step` that is expressed in the frame of this one."""
        sine, cosine = math.sin(self.alpha), math.cos(self.alpha)
        return Pose(
            self.x + step.x * cosine + step.z * sine,
            self.z - step.x * sine + step.z * cosine,
            wrap_angle(self.alpha + step.alpha),
        )

    def inverse(self) -> Pose:
        """The pose of the origin, expressed in the frame of this one."""
        sine, cosine = math.sin(self.alpha), math.cos(self.alpha)
        return Pose(-self.x * cosine + self.z * sine, -self.x * sine - self.z * cosine, -self.alpha)


ORIGIN = Pose()
"""The initial pose of odometry."""


def wrap_angle(angle: float) -> float:
    """`angle` in rad, normalised to [-pi, pi)."""
    return (angle + math.pi) % math.tau - math.pi


def arc(left: float, right: float, axis: float) -> Pose:
    """The motion of a base whose wheels, `axis` mm apart, roll `left` and `right` mm.

    Exact for a constant ratio of the two (Siegwart, Introduction to Autonomous Mobile Robots,
    ch. 5.2.4, closed form instead of its mid-point rule).
    """
    turn = (left - right) / axis
    ahead = (left + right) / 2
    if abs(turn) < 1e-9:
        return Pose(0.0, ahead, turn)
    radius = ahead / turn
    return Pose(radius * (1 - math.cos(turn)), radius * math.sin(turn), turn)
