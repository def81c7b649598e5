"""The true pose and motion of a body, in RoboComp's axes.

In: a model, its data, a body. Out: a `FullPose`. After `set` all values are expressed in the
corrected world.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.description.scene import Triple
from robocomp_dsl.hardware.devices.full_pose import FullPose
from robocomp_dsl.hardware.kinematics.rotations import Matrix, inverse
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM

_BODY = mujoco.mjtObj.mjOBJ_XBODY


class TruePose:
    """Pose of one body; call `find` first."""

    def __init__(self) -> None:
        self._correction: Matrix = np.eye(4)

    def find(self, model: Any, data: Any, body: int) -> None:
        """Find the body in a model."""
        self._model, self._data, self._body = model, data, body

    def set(self, matrix: Matrix) -> None:
        """Define the current pose of the body as `matrix`."""
        self._correction = matrix @ inverse(self._true())

    def measure(self) -> FullPose:
        """The pose after the latest step."""
        model, data = self._model, self._data
        moved, pushed = np.empty(6), np.empty(6)
        mujoco.mj_objectVelocity(model, data, _BODY, self._body, moved, 0)
        mujoco.mj_rnePostConstraint(model, data)
        mujoco.mj_objectAcceleration(model, data, _BODY, self._body, pushed, 0)
        pushed[3:] += model.opt.gravity  # MuJoCo accelerates the world upwards instead
        return FullPose(
            float(data.time),
            self._correction @ self._true(),
            self._to_scene(moved[3:] / MM),
            self._to_scene(-moved[:3]),  # a mirror reverses the sign of a rotation axis
            self._to_scene(pushed[3:] / MM),
            self._to_scene(-pushed[:3]),
        )

    def _true(self) -> Matrix:
        return axes.matrix(self._data.xpos[self._body], self._data.xmat[self._body])

    def _to_scene(self, vector: NDArray[np.float64]) -> Triple:
        """A vector in MuJoCo's axes converted to RoboComp's."""
        x, y, z = (self._correction[:3, :3] @ vector[[0, 2, 1]]).tolist()
        return x, y, z
