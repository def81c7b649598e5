"""Changes of the poses in an InnerModel.

Every change is one step: another thread sees the poses before it or after it. Lengths are mm,
angles rad.
"""

# ruff: noqa: N802, N803  names as in RoboComp

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from robocomp_dsl.hardware.kinematics.rotations import angles, pose_rows
from robocomp_dsl.innermodel.attribute_values import checked_text
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.joints import InnerModelJoint, InnerModelPrismaticJoint
from robocomp_dsl.innermodel.node_tree import POSE
from robocomp_dsl.innermodel.shared_state import SharedState, locked, number, vector
from robocomp_dsl.model import innermodel


class PoseUpdates(SharedState):
    """The writing part of `InnerModel`."""

    @locked
    def updateTransformValues(
        self,
        transformId: str,
        tx: float,
        ty: float,
        tz: float,
        rx: float,
        ry: float,
        rz: float,
        parentId: str = "",
    ) -> None:
        """Set the pose of a transform, base or joint in its parent.

        With `parentId` the pose is one in that node; it is converted, and the parent stays.
        """
        values = (tx, ty, tz, rx, ry, rz)
        pose = [number(value, name) for name, value in zip(POSE, values, strict=True)]
        self._set_pose(transformId, pose, parentId)

    def updateTransformValuesV(self, transformId: str, v: ArrayLike, parentId: str = "") -> None:
        """As `updateTransformValues`, for a pose tx, ty, tz, rx, ry, rz of shape (6,)."""
        tx, ty, tz, rx, ry, rz = vector(v, "a pose", 6).tolist()
        self.updateTransformValues(transformId, tx, ty, tz, rx, ry, rz, parentId)

    @locked
    def updateTranslationValues(
        self, transformId: str, tx: float, ty: float, tz: float, parentId: str = ""
    ) -> None:
        """Set the translation of a transform; its rotation stays.

        With `parentId` it gets the pose with this translation in that node and *no rotation*
        against it, as in RoboComp.
        """
        rx, ry, rz = (0.0, 0.0, 0.0) if parentId else self._local(transformId)[3:]
        self.updateTransformValues(transformId, tx, ty, tz, rx, ry, rz, parentId)

    @locked
    def updateRotationValues(
        self, transformId: str, rx: float, ry: float, rz: float, parentId: str = ""
    ) -> None:
        """Set the rotation of a transform; its translation stays.

        With `parentId` it gets the pose with this rotation in that node and its origin *at the
        origin of that node*, as in RoboComp.
        """
        tx, ty, tz = (0.0, 0.0, 0.0) if parentId else self._local(transformId)[:3]
        self.updateTransformValues(transformId, tx, ty, tz, rx, ry, rz, parentId)

    @locked
    def updateJointValue(self, jointId: str, angle: float, force: bool = False) -> float:
        """Set the angle of a joint in rad, within its limits unless `force`; the angle set."""
        joint = self._tree.node_of(jointId, innermodel.Joint, "a joint")
        return self._move_joint(joint, number(angle, "angle"), force)

    @locked
    def updatePrismaticJointPosition(
        self, jointId: str, position: float, force: bool = False
    ) -> float:
        """Set the position of a slide in mm, within its limits unless `force`; what was set."""
        joint = self._tree.node_of(jointId, innermodel.PrismaticJoint, "a prismatic joint")
        return self._move_joint(joint, number(position, "position"), force)

    @locked
    def updatePlaneValues(
        self, planeId: str, nx: float, ny: float, nz: float, px: float, py: float, pz: float
    ) -> None:
        """Set normal and centre of a plane in the frame that holds it."""
        plane = self._tree.node_of(planeId, innermodel.Plane, "a plane")
        self._tree.entries[planeId].node = replace(
            plane,
            nx=number(nx, "nx"),
            ny=number(ny, "ny"),
            nz=number(nz, "nz"),
            px=number(px, "px"),
            py=number(py, "py"),
            pz=number(pz, "pz"),
        )

    @locked
    def updateDisplay(self, displayId: str, texture: str) -> None:
        """Set the picture or colour of a display or plane."""
        plane = self._tree.node_of(displayId, innermodel.Plane, "a display")
        self._tree.entries[displayId].node = replace(
            plane, texture=checked_text("texture", texture)
        )

    @locked
    def getJoint(self, id: str) -> InnerModelJoint:
        """The handle of a joint: `getAngle`, `setAngle`, `unitaryAxis`."""
        joint = self._tree.node_of(id, innermodel.Joint, "a joint")
        return InnerModelJoint(joint, self._joint_value, self.updateJointValue)

    @locked
    def getPrismaticJoint(self, id: str) -> InnerModelPrismaticJoint:
        """The handle of a slide: `getPosition`, `setPosition`, `unitaryAxis`."""
        joint = self._tree.node_of(id, innermodel.PrismaticJoint, "a prismatic joint")
        write = self.updatePrismaticJointPosition
        return InnerModelPrismaticJoint(joint, self._joint_value, write)

    def update(self) -> None:
        """Does nothing: changes take effect at once. For code written for RoboComp."""

    def cleanupTables(self) -> None:
        """Does nothing: there are no tables to clean up. For code written for RoboComp."""

    # -- inside -------------------------------------------------------------------------------

    @locked
    def _joint_value(self, id: str) -> float:
        return float(self._tree.transforms.joint(self._frame(id)))

    def _move_joint(
        self, joint: innermodel.Joint | innermodel.PrismaticJoint, value: float, force: bool
    ) -> float:
        reached = value if force else min(max(value, joint.min), joint.max)
        self._tree.transforms.set_joint(joint.id, reached)
        return reached

    def _local(self, id: str) -> tuple[float, ...]:
        self._posed(id)
        return self._tree.transforms.local(id)

    def _posed(self, id: str) -> None:
        """Raise `InnerModelError` for a node without `tx` … `rz` that other nodes see."""
        node = self._tree.entry(id).node
        if isinstance(node, innermodel.PrismaticJoint):
            raise InnerModelError(f"`{id}` slides: set it by updatePrismaticJointPosition")
        if not isinstance(node, innermodel.Transform) or id == self._tree.root:
            fixed = "the root stays" if id == self._tree.root else "move the frame that holds it"
            raise InnerModelError(f"`{id}` is a `{node.tag}` without a pose of its own: {fixed}")

    def _set_pose(self, id: str, pose: list[float], parent_id: str) -> None:
        self._posed(id)
        transforms = self._tree.transforms
        if parent_id and self._frame(parent_id) != transforms.parent(id):
            above = transforms.matrix(self._frame(parent_id), transforms.parent(id))
            in_parent = above @ np.array((*pose_rows(pose), (0.0, 0.0, 0.0, 1.0)))
            pose = [*in_parent[:3, 3].tolist(), *angles(in_parent[:3, :3])]
        transforms.set_pose(id, pose)
