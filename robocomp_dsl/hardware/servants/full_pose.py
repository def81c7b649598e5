"""`FullPoseEstimation` over a base: where it is in space if it knows that, else on the floor.

In a simulator that is the true pose; the driver of a real base tells its corrected pose.
"""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.hardware.errors import finite
from robocomp_dsl.hardware.full_pose import FullPoseDevice, OnFloor
from robocomp_dsl.hardware.rotations import angles, pose_rows
from robocomp_dsl.hardware.servants.servant import Servant

_SURE = 100
"""Per cent."""


class FullPoseServant(Servant):
    """One robot."""

    @property
    def _robot(self) -> FullPoseDevice:
        found: Any = self.device()
        made: FullPoseDevice = found if hasattr(found, "full_pose") else OnFloor(found)
        return made

    def setInitialPose(self, x: float, y: float, z: float, rx: float, ry: float, rz: float) -> None:
        """Where the robot is now."""
        finite(x=x, y=y, z=z, rx=rx, ry=ry, rz=rz)
        made = np.eye(4)
        made[:3] = pose_rows((x, y, z, rx, ry, rz))
        self._robot.set_full_pose(made)

    def getFullPoseEuler(self) -> Any:
        """The pose with its angles, and how it changes."""
        it = self._robot.full_pose()
        turned = it.matrix[:3, :3]
        side, _, adv = (turned.T @ it.velocity).tolist()
        x, y, z = it.matrix[:3, 3].tolist()
        rx, ry, rz = angles(turned)
        named = {
            "v": it.velocity,
            "vr": it.turning,
            "a": it.acceleration,
            "ar": it.turning_acceleration,
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
            rot=float((turned.T @ it.turning)[1]),
            confidence=_SURE,
        )

    def getFullPoseMatrix(self) -> Any:
        """The pose as a matrix."""
        matrix = self._robot.full_pose().matrix
        numbers = {f"m{i}{j}": float(matrix[i, j]) for i in range(4) for j in range(4)}
        return self.types.FullPoseMatrix(source=self.ids[0], **numbers)
