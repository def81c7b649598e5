"""Pose and motion of a robot in space: data, and the Protocol of estimators."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from robocomp_dsl.hardware.description.scene import Triple
from robocomp_dsl.hardware.devices.mobile_base import MobileBaseDevice
from robocomp_dsl.hardware.kinematics.planar import Pose
from robocomp_dsl.hardware.kinematics.rotations import Matrix, heading, pose_rows

_REST = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class FullPose:
    """A pose at `time` (s): `matrix`, shape (4, 4), maps points of the robot to the world, in mm.

    `velocity` (mm/s), `turning` (rad/s) and the accelerations of both are those of the origin of
    the robot, in the axes of the world.
    """

    time: float
    matrix: Matrix
    velocity: Triple
    angular_velocity: Triple
    acceleration: Triple
    angular_acceleration: Triple


class FullPoseDevice(Protocol):
    """A source of the pose: a driver or a simulated body."""

    def full_pose(self) -> FullPose:
        """The latest estimate."""

    def set_full_pose(self, matrix: Matrix) -> None:
        """Reset the estimate to `matrix`, shape (4, 4), in mm."""


class FloorPose:
    """Adapts a base: its height is 0 and its accelerations are 0."""

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
        """Set the corrected pose from the planar part of the matrix."""
        x, _, z = matrix[:3, 3].tolist()
        self._base.correct(Pose(x, z, heading(matrix[:3, :3])))
