"""A URDF robot as a MuJoCo model: a body for every link, a joint for every moving one.

In: a `Robot`. Out: an `MjSpec` whose bodies and joints have the names of the file, and findings.
Visual and collision shapes are separate geoms; collision shapes of links with visual shapes are in
group 3, which viewers hide.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.description.model_paths import resolve
from robocomp_dsl.hardware.formats.urdf import (
    UrdfInertia,
    UrdfJoint,
    UrdfLink,
    UrdfPose,
    UrdfRobot,
    UrdfShape,
)
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.simulation.models.mesh_geom import MeshCache

WORLD = "world"
"""A link with this name is the world itself."""

_GEOM, _JOINT = mujoco.mjtGeom, mujoco.mjtJoint
_HIDDEN = 3
_LIGHT = 1e-3


def build_urdf(
    robot: UrdfRobot, path: Path, packages: Sequence[Path] = ()
) -> tuple[Any, list[Finding]]:
    """The model of `robot`, whose file is at `path`."""
    spec = mujoco.MjSpec()
    spec.modelname = robot.name
    spec.compiler.degree = False
    findings = list(robot.findings)
    builder = _Builder(spec, path, packages, findings, MeshCache(spec, findings))
    for link, joint in robot.links:
        builder.link(link, joint)
    for _, joint in robot.links:
        if joint and joint.leader:
            builder.follow(joint)
    return spec, findings


@dataclass(slots=True)
class _Builder:
    spec: Any
    path: Path
    packages: Sequence[Path]
    findings: list[Finding]
    meshes: MeshCache
    bodies: dict[str, Any] = field(default_factory=dict)

    def link(self, link: UrdfLink, joint: UrdfJoint | None) -> None:
        if joint is None and link.name == WORLD:
            body = self.spec.worldbody
        else:
            above = self.bodies[joint.parent] if joint else self.spec.worldbody
            pose = joint.pose if joint else UrdfPose()
            body = above.add_body(name=link.name, pos=pose.xyz, quat=quaternion(turned(pose)))
            if joint:
                _move(body, joint, above is self.spec.worldbody)
                if joint.speed > 0:  # as `model_joints` reads it
                    name = f"speed_{joint.name}"
                    self.spec.add_numeric(name=name, data=[joint.speed], size=1)
            self._weigh(body, link, moves=joint is not None and joint.kind != "fixed")
        self.bodies[link.name] = body
        for shape in link.visuals:
            self._show(body, link, shape, contype=0, conaffinity=0, group=1)
        for shape in link.collisions:
            self._show(body, link, shape, group=_HIDDEN if link.visuals else 0)

    def _weigh(self, body: Any, link: UrdfLink, *, moves: bool) -> None:
        inertia = link.inertia
        if inertia is None:
            if moves:
                message = f"`{link.name}` moves and has no mass: it gets {_LIGHT:g} kg"
                self.findings.append(model_finding("mass", link.name, message, link.line))
            inertia = UrdfInertia(_LIGHT, (_LIGHT * 1e-3,) * 3 + (0.0,) * 3, UrdfPose())
        tensor, fits = _about_link(inertia)
        if not fits:
            message = (
                f"the inertia of `{link.name}` is none that a body can have: a ball's is taken"
            )
            self.findings.append(model_finding("mass", link.name, message, link.line))
            tensor = np.eye(3) * 0.4 * inertia.mass * 0.05**2
        body.explicitinertial = True
        body.mass = inertia.mass
        body.ipos = inertia.pose.xyz
        body.fullinertia = tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]

    def _show(self, body: Any, link: UrdfLink, shape: UrdfShape, **settings: Any) -> None:
        turn = turned(shape.pose)
        geom: dict[str, Any] = {"rgba": shape.colour}
        shift = np.zeros(3)
        match shape.kind:
            case "box":
                geom |= {"type": _GEOM.mjGEOM_BOX, "size": [part / 2 for part in shape.size]}
            case "sphere":
                geom |= {"type": _GEOM.mjGEOM_SPHERE, "size": [shape.size[0], 0, 0]}
            case "cylinder" | "capsule":
                kind = _GEOM.mjGEOM_CYLINDER if shape.kind == "cylinder" else _GEOM.mjGEOM_CAPSULE
                geom |= {"type": kind, "size": [shape.size[0], shape.size[1] / 2, 0]}
            case _:
                file = resolve(shape.file, self.path, self.packages)
                settings_of_mesh = self.meshes.geom(file, shape.size, link.name, shape.line)
                if settings_of_mesh is None:
                    self.meshes.mark(body, file, np.array(shape.pose.xyz))
                    return
                geom |= settings_of_mesh
                shift = geom.pop("shift")
        place = np.array(shape.pose.xyz) + turn @ shift
        body.add_geom(pos=place, quat=quaternion(turn), density=0.0, **geom, **settings)

    def follow(self, joint: UrdfJoint) -> None:
        """A mimic joint: `offset` + `factor` times its leader."""
        data = np.zeros(mujoco.mjNEQDATA)
        data[:2] = joint.offset, joint.factor
        self.spec.add_equality(
            type=mujoco.mjtEq.mjEQ_JOINT,
            objtype=mujoco.mjtObj.mjOBJ_JOINT,
            name1=joint.name,
            name2=joint.leader,
            data=data,
        )


def _move(body: Any, joint: UrdfJoint, on_world: bool) -> None:
    axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
    options: dict[str, Any] = {
        "damping": [max(joint.damping, 0.0), 0.0, 0.0],
        "frictionloss": max(joint.friction, 0.0),
    }
    if math.isfinite(joint.low):
        options |= {"range": [joint.low, joint.high], "limited": mujoco.mjtLimited.mjLIMITED_TRUE}
    if joint.effort > 0:
        options |= {"actfrcrange": [-joint.effort, joint.effort]}
        options |= {"actfrclimited": mujoco.mjtLimited.mjLIMITED_TRUE}
    match joint.kind:
        case "revolute" | "continuous":
            body.add_joint(name=joint.name, type=_JOINT.mjJNT_HINGE, axis=axis, **options)
        case "prismatic":
            body.add_joint(name=joint.name, type=_JOINT.mjJNT_SLIDE, axis=axis, **options)
        case "planar":
            side = np.cross(np.eye(3)[int(np.argmin(np.abs(axis)))], axis)
            side /= np.linalg.norm(side)
            for name, along in (("x", side), ("y", np.cross(axis, side))):
                body.add_joint(name=f"{joint.name}.{name}", type=_JOINT.mjJNT_SLIDE, axis=along)
            body.add_joint(name=f"{joint.name}.turn", type=_JOINT.mjJNT_HINGE, axis=axis)
        case "floating" if on_world:
            body.add_joint(name=joint.name, type=_JOINT.mjJNT_FREE)
        case "floating":
            for name, along in zip("xyz", np.eye(3), strict=True):
                body.add_joint(name=f"{joint.name}.{name}", type=_JOINT.mjJNT_SLIDE, axis=along)
            body.add_joint(name=f"{joint.name}.turn", type=_JOINT.mjJNT_BALL)


def turned(pose: UrdfPose) -> Matrix:
    """Rz(yaw) · Ry(pitch) · Rx(roll), shape (3, 3)."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a), math.cos(a)) for a in pose.rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def quaternion(turn: Matrix) -> Matrix:
    """(w, x, y, z) of a rotation matrix."""
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, turn.ravel())
    return quat


def _about_link(inertia: UrdfInertia) -> tuple[Matrix, bool]:
    """The tensor along the link's axes, and whether it is physically possible."""
    xx, yy, zz, xy, xz, yz = inertia.tensor
    turn = turned(inertia.pose)
    tensor = turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
    small, middle, large = np.linalg.eigvalsh(tensor).tolist()
    return tensor, small > 1e-14 and small + middle >= large * (1 - 1e-6)
