"""Converts a compiled MuJoCo model to a tree of frames.

In: an `MjModel`. Out: frames in RoboComp's axes and mm for `TransformTree`, and the mapping of
joint positions. A joint about any axis through any point becomes a fixed frame whose z is the axis,
a joint about z, and the inverse frame, so that the tree needs only a few kinds of frames.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.description.scene import ROOT, Frame, Motion, Triple
from robocomp_dsl.hardware.devices.errors import require_finite
from robocomp_dsl.hardware.kinematics.rotations import Matrix, angles, inverse
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.simulation.models.mesh_marker import is_marker
from robocomp_dsl.simulation.scene import axes

_JOINT = mujoco.mjtJoint
_SINGLE = {_JOINT.mjJNT_HINGE: "hinge", _JOINT.mjJNT_SLIDE: "slide"}


@dataclass(frozen=True, slots=True)
class ModelJoint:
    """A joint of the model and the frame that moves with it.

    `address` is its first index in `qpos`, `zero` the value there in the initial pose.
    """

    name: str
    frame: str
    kind: int
    address: int
    zero: float


@dataclass(slots=True)
class ModelTransforms:
    """`tree` with the model's bodies; `bodies[i]` is the frame of body i, `joints` are the joints.

    `sites[i]` is the frame of site i, empty for an unnamed one.
    """

    tree: TransformTree
    bodies: tuple[str, ...]
    joints: tuple[ModelJoint, ...]
    sites: tuple[str, ...] = ()

    def follow(self, qpos: Sequence[float] | NDArray[np.float64]) -> None:
        """Set all joints to MuJoCo's `qpos`, shape (nq,); rejects values that are not finite."""
        for joint in self.joints:
            at = joint.address
            if joint.kind in _SINGLE:
                unit = 1.0 if joint.kind == _JOINT.mjJNT_HINGE else 1 / axes.MM
                self.tree.set_joint(joint.frame, (float(qpos[at]) - joint.zero) * unit)
            else:
                self.tree.set_pose(joint.frame, _loose(joint, qpos))


def model_transforms(model: Any) -> ModelTransforms:
    """The frames of `model`, at `qpos0`."""
    return _Builder(model).all()


@dataclass(slots=True)
class _Builder:
    model: Any
    names: set[str] = field(default_factory=lambda: {ROOT})
    tree: TransformTree = field(default_factory=TransformTree)
    joints: list[ModelJoint] = field(default_factory=list)

    def all(self) -> ModelTransforms:
        # bodies are named first, because users refer to them
        bodies = [ROOT, *(self._free(self._body_name(i)) for i in range(1, self.model.nbody))]
        for i in range(1, self.model.nbody):
            self._body(i, bodies[i], bodies[self.model.body_parentid[i]])
        sites = tuple(self._site(i, bodies) for i in range(self.model.nsite))
        return ModelTransforms(self.tree, tuple(bodies), tuple(self.joints), sites)

    def _site(self, i: int, bodies: Sequence[str]) -> str:
        name = self.model.site(i).name
        if not name or is_marker(name):
            return ""
        pose = _pose(self.model.site_pos[i], self.model.site_quat[i])
        return self._fixed(self._free(name), bodies[self.model.site_bodyid[i]], pose)

    def _body_name(self, i: int) -> str:
        return self.model.body(i).name or f"body{i}"

    def _free(self, name: str) -> str:
        """`name`, followed by a number if it is taken."""
        free, number = name, 2
        while free in self.names:
            free, number = f"{name}#{number}", number + 1
        self.names.add(free)
        return free

    def _fixed(self, name: str, parent: str, pose: Matrix) -> str:
        place: Triple = tuple(pose[:3, 3].tolist())
        self.tree.add(Frame(name, parent, place, angles(pose[:3, :3])))
        return name

    def _body(self, i: int, name: str, parent: str) -> None:
        """F · (there · joint · back) for every joint; frames between two joints are merged."""
        model = self.model
        pending = _pose(model.body_pos[i], model.body_quat[i])
        first = int(model.body_jntadr[i])
        for j in range(first, first + int(model.body_jntnum[i])):
            frame = self._free(model.joint(j).name or f"{name}.joint{j - first}")
            kind = _JOINT(model.jnt_type[j])
            address = int(model.jnt_qposadr[j])
            zero = float(model.qpos0[address])
            self.joints.append(ModelJoint(model.joint(j).name, frame, int(kind), address, zero))
            if kind == _JOINT.mjJNT_FREE:
                self.tree.add(Frame(frame, parent))
                self.tree.set_pose(frame, _loose(self.joints[-1], model.qpos0))
                parent, pending = frame, np.eye(4)
                continue
            there = _there(kind, model.jnt_axis[j], model.jnt_pos[j])
            before = self._fixed(self._free(f"{frame}.at"), parent, pending @ there)
            self.tree.add(Frame(frame, before, motion=self._motion(j, kind)))
            parent, pending = frame, inverse(there)
        self._fixed(name, parent, pending)

    def _motion(self, j: int, kind: Any) -> Motion | None:
        if kind not in _SINGLE:
            return None
        if not self.model.jnt_limited[j]:
            return Motion(_SINGLE[kind], "z")  # type: ignore[arg-type]
        unit = 1.0 if kind == _JOINT.mjJNT_HINGE else 1 / axes.MM
        zero = self.model.qpos0[self.model.jnt_qposadr[j]]
        low, high = ((self.model.jnt_range[j] - zero) * unit).tolist()
        return Motion(_SINGLE[kind], "z", low, high)  # type: ignore[arg-type]


def _there(kind: Any, axis: Matrix, place: Matrix) -> Matrix:
    """A frame at the joint whose z is the joint's axis."""
    pose = np.eye(4)
    if kind != _JOINT.mjJNT_SLIDE:
        pose[:3, 3] = np.asarray(place)[[0, 2, 1]] / axes.MM
    if kind == _JOINT.mjJNT_BALL:
        return pose
    along = axes.turn_axis(axis) if kind == _JOINT.mjJNT_HINGE else axes.direction(axis.tolist())
    pose[:3, :3] = _turned_to(np.array(along))
    return pose


def _turned_to(z: Matrix) -> Matrix:
    """A rotation whose third column is `z`, of any length but 0."""
    z = z / np.linalg.norm(z)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    return np.stack((x, np.cross(z, x), z), axis=1)


def _pose(position: Matrix, quaternion: Matrix) -> Matrix:
    """A MuJoCo pose as a RoboComp matrix, in mm."""
    turned = np.zeros(9)
    unit = np.array(quaternion, dtype=float)
    mujoco.mju_normalize4(unit)
    mujoco.mju_quat2Mat(turned, unit)
    return axes.matrix(position, turned)


def _loose(joint: ModelJoint, qpos: Sequence[float] | NDArray[np.float64]) -> list[float]:
    """The pose of a ball joint or free body from its numbers in `qpos`."""
    free = joint.kind == _JOINT.mjJNT_FREE
    numbers = np.array(qpos[joint.address : joint.address + (7 if free else 4)], dtype=float)
    require_finite(**{f"{joint.frame}[{i}]": float(number) for i, number in enumerate(numbers)})
    pose = _pose(numbers[:3] if free else np.zeros(3), numbers[-4:])
    return [*pose[:3, 3].tolist(), *angles(pose[:3, :3])]
