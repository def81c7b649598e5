"""An end effector of a model file, moved by a Cartesian controller.

In: the board of the world, which of its joints, a body or site as tip, a body as base. Out: poses
and goals in m, in the axes of the model.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.kinematics.cartesian import JointChain
from robocomp_dsl.hardware.kinematics.cartesian_controller import CartesianController
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.simulation.devices.control_board_chain import extract_chain
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.scene_joints import JointBoard
from robocomp_dsl.tactile.arm.inverse import Solution


class CartesianEndEffector:
    """A part of the world; `controller` exists after `bind`; its goals are in mm."""

    controller: CartesianController

    def __init__(self, board: JointBoard, joints: tuple[str, ...], tip: str, base: str) -> None:
        self.joint_board, self._joints = board, joints
        self._tip, self._base = tip, base

    def build(self, spec: Any) -> None:
        """Nothing to add: board and tip exist."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002 - shared
        """Create the controller on the board. Raises `SceneError`."""
        chain = self._chain(model)
        self.controller = CartesianController(self.joint_board.board, chain, self._joints)

    def find(self, model: Any, data: Any) -> None:  # noqa: ARG002 - shared
        """The same end effector in another model."""
        self.controller.set_chain(self._chain(model))

    def pose(self) -> Matrix:
        """The pose of the end effector, (4, 4)."""
        return axes.body(self.controller.pose())

    def solution_pose(
        self, found: Solution
    ) -> tuple[Matrix, np.ndarray[Any, np.dtype[np.float64]]]:
        """The pose of a solution, (4, 4), and all joints of the chain, (n,)."""
        q = self.controller.posture.copy()
        q[self.controller.free] = found.q
        return axes.body(self.controller.chain.pose(found.q)), q

    @staticmethod
    def goal(pose: Matrix) -> Matrix:
        """The goal of a pose, (4, 4), or a position, (3,) [m], in mm. Raises `CommandRefused`."""
        if not np.isfinite(pose).all():
            raise CommandRefused("the goal holds NaN or infinity")
        if pose.ndim == 1:
            return pose[[0, 2, 1]] / axes.MM
        return axes.matrix(pose[:3, 3], pose[:3, :3])

    def _chain(self, model: Any) -> JointChain:
        return extract_chain(model, self._joints, self._tip, base=self._base)
