"""Points, poses and matrices between any two nodes of an InnerModel.

Arguments come as in RoboComp: first the node in which the result is expressed, last the node in
which the input is. Lengths are mm, angles rad.
"""

# ruff: noqa: N802, N803  names as in RoboComp

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from robocomp_dsl.hardware.kinematics.jacobian import jacobian
from robocomp_dsl.hardware.kinematics.rotations import angles, rotation
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.shared_state import Floats, SharedState, locked, number, vector
from robocomp_dsl.model import innermodel

_ORIGIN = (0.0, 0.0, 0.0)


class PoseQueries(SharedState):
    """The reading part of `InnerModel`."""

    def transform(self, destId: str, origVec: ArrayLike, origId: ArrayLike | None = None) -> Floats:
        """What is given in `origId`, expressed in `destId`.

        `origVec` is a point of shape (3,), points of shape (n, 3), or a pose x, y, z, rx, ry, rz of
        shape (6,); the result has the same shape. Without it, `transform(destId, origId)`, it is
        the origin. The order `transform(destId, origId, origVec)` is accepted, too.
        """
        point, node = _point_and_node(origVec, origId, _ORIGIN)
        try:
            values = np.asarray(point, dtype=float)
        except (TypeError, ValueError):
            raise InnerModelError(f"a point consists of numbers, not {point!r:.80}") from None
        with self.lock:
            tree, target, source = self._tree.transforms, self._frame(destId), self._frame(node)
            if values.shape == (3,):
                return np.array(tree.transform(values.tolist(), source, target))
            if values.ndim == 2 and values.shape[1] == 3:
                return tree.transform_all(values, source, target)
            if values.shape == (6,):
                matrix = tree.matrix(source, target)
                place = matrix[:3, :3] @ values[:3] + matrix[:3, 3]
                turned = matrix[:3, :3] @ rotation(*values[3:].tolist())
                return np.array((*place.tolist(), *angles(turned)))
        raise InnerModelError(
            f"transform takes 3 or 6 numbers or an array (n, 3), not the shape {values.shape}"
        )

    def transform6D(
        self, destId: str, origVec: ArrayLike, origId: ArrayLike | None = None
    ) -> Floats:
        """The pose x, y, z, rx, ry, rz in `origId`, expressed in `destId`; shape (6,).

        Without `origVec` it is the pose of `origId` itself. Of the two solutions for the angles it
        has the one of smaller norm.
        """
        pose, node = _point_and_node(origVec, origId, np.zeros(6))
        return self.transform(destId, vector(pose, "a pose", 6), node)

    @locked
    def getTransformationMatrix(self, destId: str, origId: str) -> Floats:
        """The transform of points from `origId` to `destId`; shape (4, 4)."""
        return self._tree.transforms.matrix(self._frame(origId), self._frame(destId))

    def getRotationMatrixTo(self, to: str, from_: str) -> Floats:
        """The rotation from `from_` to `to`; shape (3, 3)."""
        return self.getTransformationMatrix(to, from_)[:3, :3].copy()

    def getTranslationVectorTo(self, to: str, from_: str) -> Floats:
        """The origin of `from_` in `to`; shape (3,). In RoboComp a fourth number, 1, follows."""
        return self.getTransformationMatrix(to, from_)[:3, 3].copy()

    def rotationAngles(self, destId: str, origId: str) -> Floats:
        """rx, ry, rz of the rotation from `origId` to `destId`, the solution of smaller norm."""
        return np.array(angles(self.getTransformationMatrix(destId, origId)[:3, :3]))

    @locked
    def jacobian(self, listaJoints: Sequence[str], motores: ArrayLike, endEffector: str) -> Floats:
        """RoboComp's Jacobian of `endEffector`, in the frame of the last joint; shape (6, joints).

        A column is *minus* the motion of the end effector per rad of a joint (per mm of a slide):
        x, y, z in mm, then the rotation in rad (RoboComp, InnerModel::jacobian, whose signs these
        are). A joint whose entry in `motores` is not 0 is held, and has a column of zeros.
        """
        joints = list(listaJoints)
        if not joints:
            raise InnerModelError("a Jacobian needs at least one joint")
        held = vector(motores, "`motores`", len(joints)) != 0
        frames = [self._frame(joint) for joint in joints]
        tip = self._frame(endEffector)
        columns = jacobian(self._tree.transforms, frames, tip, base=frames[-1])
        columns[:, held] = 0.0
        return -columns

    @locked
    def laserTo(self, dest: str, laserId: str, r: float, alfa: float) -> Floats:
        """The point that a laser measures at `r` mm and `alfa` rad, in `dest`; shape (3,)."""
        self._tree.node_of(laserId, innermodel.Laser, "a laser")
        distance, angle = number(r, "r"), number(alfa, "alfa")
        point = (distance * math.sin(angle), 0.0, distance * math.cos(angle))
        return self.transform(dest, point, laserId)


def _point_and_node(
    written: ArrayLike, node: ArrayLike | None, default: ArrayLike
) -> tuple[ArrayLike, str]:
    """The two arguments in the order point, node; `default` if there is no point."""
    if isinstance(written, str):
        return default if node is None else node, written
    if not isinstance(node, str):
        raise InnerModelError("transform needs two nodes: transform(to, point, from)")
    return written, node
