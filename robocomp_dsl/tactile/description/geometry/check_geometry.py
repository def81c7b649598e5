"""Check a tactile description against the geometry of the robot's model.

In: a description whose joints and bodies the model has. Out: findings, each at its item. A servo,
limb or chain that depends on a wrong one is not reported, because it would be a follow-on error.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.check import MAX_SURFACE_DISTANCE
from robocomp_dsl.tactile.description.geometry.arm_axes import (
    directions,
    find_servo_fault,
    is_arm,
)
from robocomp_dsl.tactile.description.geometry.chain_axes import find_chain_fault
from robocomp_dsl.tactile.description.geometry.limb_frames import find_limb_faults
from robocomp_dsl.tactile.description.geometry.posed_model import PosedModel
from robocomp_dsl.tactile.description.model import GenericPart, Limb, RobotDescription
from robocomp_dsl.tactile.errors import Fault

_STRAY_SHARE = 0.05
"""The share of taxels that may be away from the surface of the model."""
_RINGS, _AROUND = 5, 12


def check_geometry(robot: RobotDescription, model: PosedModel) -> list[Finding]:
    """The findings about frames, gamma, sigma, chains and surfaces of all parts."""
    return [finding for part in robot.parts for finding in check_part(robot, part, model)]


def check_part(robot: RobotDescription, part: GenericPart, model: PosedModel) -> list[Finding]:
    """The findings about one part of `robot`."""
    if not any(servo.joint for servo in part.servos):
        return []
    model.set_pose(part, np.zeros(len(part.servos)))
    way = None
    if is_arm(part):
        way = directions(robot, part, model)
        servo = find_servo_fault(part, model, way)
        if servo:
            place = part.servos[servo.index].place
            return [Finding(place, servo.message, help=servo.help, kind=Fault.DIRECTION)]
    frames = find_limb_faults(robot, part, model, way)
    findings = [
        Finding(fault.limb.place, fault.message, help=fault.help, kind=Fault.FRAME)
        for fault in frames
    ]
    wrong = {fault.limb.name for fault in frames}
    for limb in part.limbs:
        finding = None if limb.name in wrong else _check_surface(limb, part, model)
        findings += [finding] if finding else []
    return findings + _check_chain(part, model)


def _check_chain(part: GenericPart, model: PosedModel) -> list[Finding]:
    if part.tip and model.pose(part.tip) is None:
        message = f"`tip` of the chain, `{part.tip}`, is no body and no site of the model"
        return [Finding(part.chain_place, message, kind=Fault.BODY)]
    fault = find_chain_fault(part, model)
    if fault is None:
        return []
    rows = [place for servo, place in part.row_places if fault.servo in (None, servo)]
    place = rows[-1] if rows else part.chain_place
    return [Finding(place, fault.message, help=fault.help, kind=Fault.CHAIN)]


def _check_surface(limb: Limb, part: GenericPart, model: PosedModel) -> Finding | None:
    """The skin of a limb, or its cone without skin, away from the shapes of its bodies."""
    pose = model.pose(limb.body)
    if pose is None:
        return None
    skin = [patch.points for patch in part.patches if patch.limb == limb.name]
    points = np.concatenate(skin) if skin else _cone_points(limb)
    world = limb.to_body(points) @ pose[:3, :3].T + pose[:3, 3]
    distances = model.surface_distances((limb.body, *limb.covers), world)
    if distances is None or not len(distances):
        return None
    away = np.abs(distances) > MAX_SURFACE_DISTANCE
    if np.mean(away) <= _STRAY_SHARE:
        return None
    farthest = 1000 * float(np.abs(distances).max())
    what = "taxels" if skin else "points of the cone"
    share = f"{np.mean(away):.0%} of the {what} of `{limb.name}`"
    message = f"{share} are away from the surface of the model, by up to {farthest:.0f} mm"
    bodies = ", ".join(f"`{body}`" for body in (limb.body, *limb.covers))
    help_text = f"compare `position`, `rpy`, `cone` and `covers` with the shapes of {bodies}"
    return Finding(limb.place, message, help=help_text, kind=Fault.SURFACE)


def _cone_points(limb: Limb) -> Floats:
    x = np.repeat(np.linspace(limb.cone.x0, limb.cone.x1, _RINGS), _AROUND)
    theta = np.tile(np.linspace(0, 2 * np.pi, _AROUND, endpoint=False), _RINGS)
    rho = limb.cone.radius(x)
    points: Floats = np.stack((x, rho * np.sin(theta), rho * np.cos(theta)), axis=1)
    return points
