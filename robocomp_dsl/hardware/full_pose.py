"""Where a robot is in space and how it moves: its data and the Protocol of what estimates it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.hardware.rotations import Matrix
from robocomp_dsl.hardware.scene import Triple


@dataclass(frozen=True, slots=True, eq=False)
class FullPose:
    """A pose at `time` (s): `matrix`, shape (4, 4), takes points of the robot to the world, in mm.

    `velocity` (mm/s), `turning` (rad/s) and the accelerations of both are those of the origin of
    the robot, in the axes of the world.
    """

    time: float
    matrix: Matrix
    velocity: Triple
    turning: Triple
    acceleration: Triple
    turning_acceleration: Triple


class FullPoseDevice(Protocol):
    """What tells the pose; a driver or a simulated body."""

    def full_pose(self) -> FullPose:
        """The latest estimate."""

    def set_full_pose(self, matrix: Matrix) -> None:
        """The robot is at `matrix`, shape (4, 4), in mm: estimates go on from there."""
