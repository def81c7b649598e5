"""The check of limb frames: origin, direction of x, and theta = 0.

In: a robot, a part, and the robot's model at generic zero of the part. Out: one message for each
wrong frame. The origin of a limb is on the proximal joint, x runs along the limb, and +z (theta =
0) points away from the trunk.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.geometry.arm_axes import ArmDirections
from robocomp_dsl.tactile.description.geometry.posed_model import JointAxis, PosedModel
from robocomp_dsl.tactile.description.model import GenericPart, Limb, RobotDescription

_ORIGIN_TOLERANCE = 0.03
_X_TOLERANCE = np.radians(25)
_THETA_TOLERANCE = np.radians(40)
_TWIST = np.radians(30)
"""A joint whose axis is nearer than this to x turns the limb about itself: it may be anywhere."""

_DISTAL = 0.03
"""Joints nearer to the origin [m] say nothing about the direction of the limb."""


@dataclass(frozen=True, slots=True)
class LimbFault:
    """A limb whose frame does not fit the model."""

    limb: Limb
    message: str
    help: str


def find_limb_faults(
    robot: RobotDescription, part: GenericPart, model: PosedModel, way: ArmDirections | None
) -> list[LimbFault]:
    """The first fault of each limb; without `way` theta is not checked."""
    return [
        fault
        for limb in part.limbs
        for fault in [_part_fault(limb, robot, part, model) or _find_fault(limb, part, model, way)]
        if fault is not None
    ]


def _part_fault(
    limb: Limb, robot: RobotDescription, part: GenericPart, model: PosedModel
) -> LimbFault | None:
    """A limb on a body that another part of the robot moves."""
    above = model.joints_above(limb.body)
    if any(_moves(part, joint) for joint in above):
        return None
    other = next((o for o in robot.parts if any(_moves(o, joint) for joint in above)), None)
    if other is None:
        return None
    message = f"the limb `{limb.name}` of `{part.name}` is on `{limb.body}`"
    return LimbFault(limb, f"{message}, which `{other.name}` moves", "change `body`")


def _find_fault(
    limb: Limb, part: GenericPart, model: PosedModel, way: ArmDirections | None
) -> LimbFault | None:
    pose = model.pose(limb.body)
    moving = [name for name in model.joints_above(limb.body) if _moves(part, name)]
    if pose is None or not moving:
        return None
    axes: Floats = pose[:3, :3] @ limb.axes
    origin: Floats = pose[:3, :3] @ limb.origin + pose[:3, 3]
    proximal = _proximal([model.joint(name) for name in moving], axes[:, 0])
    return (
        _x_fault(limb, proximal.point, axes[:, 0], model)
        or _origin_fault(limb, proximal, origin)
        or (_theta_fault(limb, axes, way) if way else None)
    )


def _x_fault(limb: Limb, joint: Floats, x: Floats, model: PosedModel) -> LimbFault | None:
    target, what = _distal(limb, joint, model)
    along = target - joint
    length = float(np.linalg.norm(along))
    if length < _DISTAL:
        return None
    angle = float(np.arccos(np.clip(x @ along / length, -1.0, 1.0)))
    if angle <= _X_TOLERANCE:
        return None
    message = f"x of the limb `{limb.name}` is {np.degrees(angle):.0f} deg from the limb"
    return LimbFault(limb, message, f"x points from the proximal joint to {what}; change `rpy`")


def _origin_fault(limb: Limb, joint: JointAxis, origin: Floats) -> LimbFault | None:
    distance = float(np.linalg.norm(origin - joint.point))
    if distance <= _ORIGIN_TOLERANCE:
        return None
    message = f"the origin of the limb `{limb.name}` is {_length(distance)} from its proximal joint"
    unit = "; a length without a unit is in metres" if distance > 1.0 else ""
    return LimbFault(limb, message, f"the joint is `{joint.joint}`; change `position`{unit}")


def _theta_fault(limb: Limb, axes: Floats, way: ArmDirections) -> LimbFault | None:
    away = way.outward - axes[:, 0] * (axes[:, 0] @ way.outward)
    away /= np.linalg.norm(away) or 1.0
    sine, cosine = float(axes[:, 1] @ away), float(axes[:, 2] @ away)
    angle = float(np.arctan2(sine, cosine))
    if abs(angle) <= _THETA_TOLERANCE:
        return None
    points = way.name(axes[:, 2])
    message = f"theta = 0 of the limb `{limb.name}` points {points}, not away from the trunk"
    turn = f"at generic zero theta {np.degrees(angle):.0f} deg does; change `rpy`"
    return LimbFault(limb, message, turn)


def _proximal(joints: list[JointAxis], x: Floats) -> JointAxis:
    """The nearest joint that bends: it does not only turn the limb about its own x."""
    bending = [joint for joint in joints if abs(joint.direction @ x) < np.cos(_TWIST)]
    return bending[0] if bending else joints[-1]


def _distal(limb: Limb, joint: Floats, model: PosedModel) -> tuple[Floats, str]:
    """Where the limb ends: at its next joint, else the direction of what it carries."""
    for name in model.joints_below(limb.body):
        point = model.joint(name).point
        if np.linalg.norm(point - joint) > _DISTAL:
            return point, f"`{name}`"
    return model.centre(limb.body), "the centre of mass of what it carries"


def _moves(part: GenericPart, joint: str) -> bool:
    return any(servo.joint == joint for servo in part.servos)


def _length(metres: float) -> str:
    return f"{1000 * metres:.0f} mm" if metres < 1.0 else f"{metres:.3g} m"
