"""Where a robot is in space and how it moves: its data and the Protocol of what estimates it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from robocomp_dsl.hardware.mobile_base import MobileBaseDevice
from robocomp_dsl.hardware.planar import Pose
from robocomp_dsl.hardware.rotations import Matrix, angles, pose_rows
from robocomp_dsl.hardware.scene import Triple

_REST = (0.0, 0.0, 0.0)


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


class OnFloor:
    """A base as such a device: it stands at height 0 and tells no accelerations."""

    def __init__(self, base: MobileBaseDevice) -> None:
        self._base = base

    def full_pose(self) -> FullPose:
        """The corrected pose."""
        it = self._base.state()
        matrix = np.eye(4)
        matrix[:3] = pose_rows((it.corrected.x, 0.0, it.corrected.z, 0.0, it.corrected.alpha, 0.0))
        vx, vy, vz = (matrix[:3, :3] @ (it.side, 0.0, it.adv)).tolist()
        return FullPose(it.time, matrix, (vx, vy, vz), (0.0, it.rot, 0.0), _REST, _REST)

    def set_full_pose(self, matrix: Matrix) -> None:
        """The corrected pose goes on from what of the matrix lies on the floor."""
        x, _, z = matrix[:3, 3].tolist()
        self._base.correct(Pose(x, z, angles(matrix[:3, :3])[1]))
