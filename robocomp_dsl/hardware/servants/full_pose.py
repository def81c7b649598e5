"""`FullPoseEstimation` over a base: its pose in space if known, else its pose on the floor.

In a simulator it is the true pose; the driver of a real base reports its corrected pose.
"""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.hardware.devices.errors import require_finite
from robocomp_dsl.hardware.devices.full_pose import FloorPose, FullPoseDevice
from robocomp_dsl.hardware.kinematics.rotations import angles, pose_rows
from robocomp_dsl.hardware.servants.servant import Servant

_SURE = 100
"""Per cent."""


class FullPoseServant(Servant):
    """One robot."""

    @property
    def _robot(self) -> FullPoseDevice:
        found: Any = self.device()
        robot: FullPoseDevice = found if hasattr(found, "full_pose") else FloorPose(found)
        return robot

    def setInitialPose(self, x: float, y: float, z: float, rx: float, ry: float, rz: float) -> None:
        """The current pose of the robot."""
        require_finite(x=x, y=y, z=z, rx=rx, ry=ry, rz=rz)
        matrix = np.eye(4)
        matrix[:3] = pose_rows((x, y, z, rx, ry, rz))
        self._robot.set_full_pose(matrix)

    def getFullPoseEuler(self) -> Any:
        """The pose with its angles, and its derivatives."""
        it = self._robot.full_pose()
        turned = it.matrix[:3, :3]
        side, _, adv = (turned.T @ it.velocity).tolist()
        x, y, z = it.matrix[:3, 3].tolist()
        rx, ry, rz = angles(turned)
        named = {
            "v": it.velocity,
            "vr": it.angular_velocity,
            "a": it.acceleration,
            "ar": it.angular_acceleration,
        }
        rates = {
            f"{name}{axis}": part
            for name, vector in named.items()
            for axis, part in zip("xyz", vector, strict=True)
        }
        return self.types.FullPoseEuler(
            source=self.ids[0],
            x=x,
            y=y,
            z=z,
            rx=rx,
            ry=ry,
            rz=rz,
            **rates,
            adv=adv,
            side=side,
            rot=float((turned.T @ it.angular_velocity)[1]),
            confidence=_SURE,
        )

    def getFullPoseMatrix(self) -> Any:
        """The pose as a matrix."""
        matrix = self._robot.full_pose().matrix
        numbers = {f"m{i}{j}": float(matrix[i, j]) for i in range(4) for j in range(4)}
        return self.types.FullPoseMatrix(source=self.ids[0], **numbers)
