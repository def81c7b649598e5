"""Build a MuJoCo model of a robot.

In: `RobotModel`. Out: bodies, joints, motors and sites in an `MjSpec`. A motor has the name of its
joint and takes a torque [N m]; each named point is a site; every geom has the name of its body.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.robots.links import (
    Floats,
    Joint,
    Link,
    RobotModel,
    Shape,
    shift,
    turned,
)

_KINDS = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "ball": mujoco.mjtGeom.mjGEOM_SPHERE,
    "capsule": mujoco.mjtGeom.mjGEOM_CAPSULE,
}


def new_world(timestep: float = 0.001) -> Any:
    """An empty `MjSpec` with gravity, angles in radians."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = timestep
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    return spec


def add_robot(spec: Any, robot: RobotModel, *, prefix: str = "", free: bool = False) -> None:
    """Add the robot to `spec`, with its root fixed in the world or `free`.

    `prefix` precedes every name. The angles of `spec` must be in radians.
    """
    if spec.compiler.degree:
        raise ValueError("a robot needs a world that counts angles in radians")
    bodies: dict[str, Any] = {}
    for link in robot.links:
        parent = bodies[link.parent] if link.parent else spec.worldbody
        root = turned(shift(0, 0, robot.height), 2, robot.heading)
        pose = link.pose if link.parent else root @ link.pose
        bodies[link.name] = _add_link(parent, link, pose, prefix)
        if free and not link.parent:
            bodies[link.name].add_freejoint()
    for robot_link, other in robot.neighbours:
        spec.add_exclude(bodyname1=prefix + robot_link, bodyname2=prefix + other)
    for joint in robot.joints.values():
        _drive(spec, joint, prefix)


def set_pose(model: Any, data: Any, robot: RobotModel, prefix: str = "", **angles: float) -> None:
    """Set the robot's joints to its start pose, changed by `angles`, at rest."""
    for name in robot.joints:
        joint = robot.joints[name]
        requested = angles.get(name, robot.start.get(name, 0.0))
        if joint.leader:
            requested = angles.get(joint.leader, robot.start.get(joint.leader, 0.0))
        address = model.joint(prefix + name).qposadr[0]
        data.qpos[address] = requested
        data.qvel[model.joint(prefix + name).dofadr[0]] = 0.0
    mujoco.mj_forward(model, data)


def _add_link(parent: Any, link: Link, pose: Floats, prefix: str) -> Any:
    body = parent.add_body(name=prefix + link.name, pos=pose[:3, 3], quat=quaternion(pose))
    body.explicitinertial = True
    body.mass = link.mass.mass
    body.ipos = link.mass.centre
    body.inertia = link.mass.inertia
    if link.joint:
        _add_joint(body, link.joint, prefix)
    for i, shape in enumerate(link.shapes):
        _add_shape(body, shape, prefix + link.name + (f"_{i}" if i else ""))
    for name, point in link.points.items():
        body.add_site(name=prefix + name, pos=point[:3, 3], quat=quaternion(point))
    return body


def _add_joint(body: Any, joint: Joint, prefix: str) -> None:
    body.add_joint(
        name=prefix + joint.name,
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=joint.axis,
        range=[joint.low, joint.high],
        limited=True,
        armature=joint.armature,
        damping=[joint.damping, 0.0, 0.0],
    )


def _add_shape(body: Any, shape: Shape, name: str) -> None:
    size = np.zeros(3)
    size[: len(shape.size)] = shape.size
    body.add_geom(
        name=name,
        type=_KINDS[shape.kind],
        size=size,
        pos=shape.pose[:3, 3],
        quat=quaternion(shape.pose),
        mass=0.0,
        friction=[0.6, 0.005, 0.0001],
    )


def _drive(spec: Any, joint: Joint, prefix: str) -> None:
    """A torque motor, or the coupling to the joint whose motor it shares."""
    if joint.leader:
        follow = np.zeros(mujoco.mjNEQDATA)
        follow[1] = 1.0  # the ratio of the follower's angle to the leader's
        spec.add_equality(
            type=mujoco.mjtEq.mjEQ_JOINT,
            objtype=mujoco.mjtObj.mjOBJ_JOINT,
            name1=prefix + joint.name,
            name2=prefix + joint.leader,
            data=follow,
        )
        return
    spec.add_actuator(
        name=prefix + joint.name,
        target=prefix + joint.name,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
        ctrlrange=[-joint.effort, joint.effort],
        ctrllimited=True,
    )


def quaternion(pose: Floats) -> Floats:
    """The rotation of a pose as MuJoCo's (w, x, y, z)."""
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, pose[:3, :3].ravel())
    return quat
