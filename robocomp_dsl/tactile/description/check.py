"""Check a tactile description: the constraints between its values.

In: the `RobotDescription`, and the joints and bodies of the robot's model if known. Out: findings
in the reader, each at the line of its item.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

import numpy as np

from robocomp_dsl.finding import Finding, Location
from robocomp_dsl.tactile.description.model import (
    FixedJoint,
    GenericPart,
    Limb,
    Patch,
    RobotDescription,
    Servo,
)
from robocomp_dsl.tactile.description.yaml_reader import UNITS, degrees_hint
from robocomp_dsl.tactile.errors import DescriptionError, Fault

MAX_SURFACE_DISTANCE = 0.015
"""Largest distance of a taxel from its limb's cone [m]."""

MAX_ANGLE = 2 * np.pi
"""Largest angle of an arm's joint from the generic zero [rad]."""

ReportFinding = Callable[[Fault, Location, str, str], None]


@dataclass(frozen=True, slots=True)
class RobotStructure:
    """The robot's model: limits of its joints [rad, m] and names of its bodies."""

    joints: Mapping[str, tuple[float, float]]
    bodies: frozenset[str]


def check(robot: RobotDescription, findings: list[Finding]) -> None:
    """Check the description on its own; adds to `findings`."""
    complain = _reporter(findings)
    for part in robot.parts:
        for servo in part.servos:
            _check_servo(servo, complain)
        _check_unique_joints(part, complain)
        _check_fixed_joint_parts(part, complain)
        for patch in part.patches:
            _check_taxel_positions(part, patch, complain)
    _check_unique_ids(robot, complain)
    _check_unique_patches(robot, complain)
    _check_unique_bodies(robot, complain)


def compare(robot: RobotDescription, structure: RobotStructure) -> None:
    """Check the description against the joints and bodies of the robot's model.

    Raises `DescriptionError` for joints and bodies that do not exist, and for limits that are wider
    than the robot's.
    """
    findings: list[Finding] = []
    complain = _reporter(findings)
    for part in robot.parts:
        for servo in part.servos:
            if servo.joint:
                _compare_servo(servo, structure.joints, complain)
        for held in part.fixed_joints:
            _compare_fixed_joint(held, structure.joints, complain)
        for limb in part.limbs:
            _compare_limb(limb, structure.bodies, complain)
    if findings:
        raise DescriptionError(findings)


def _reporter(findings: list[Finding]) -> ReportFinding:
    def complain(fault: Fault, place: Location, message: str, help: str) -> None:
        findings.append(Finding(place, message, help=help, kind=fault))

    return complain


def _check_servo(servo: Servo, complain: ReportFinding) -> None:
    if not servo.joint:
        if not servo.low <= servo.sigma <= servo.high:
            message = f"sigma {servo.sigma:g} of the missing joint is outside its limits"
            allowed = f"the limits are {servo.low:g} to {servo.high:g} {servo.unit}"
            complain(Fault.LIMITS, servo.place, message, allowed)
        return
    if servo.speed <= 0.0:
        complain(Fault.FORM, servo.place, f"the speed of `{servo.joint}` must be positive", "")
    for name, value in (("stiffness", servo.stiffness), ("damping", servo.damping)):
        if value < 0.0:
            message = f"the {name} of `{servo.joint}` must not be negative"
            complain(Fault.FORM, servo.place, message, "")
    if not servo.low <= servo.start <= servo.high:
        message = f"the start pose {servo.start:g} of `{servo.joint}` is outside its limits"
        allowed = f"the limits are {servo.low:g} to {servo.high:g} {servo.unit}"
        degrees = "" if servo.unit == "deg" else degrees_hint(servo.start, servo.high)
        complain(Fault.LIMITS, servo.place, message, allowed + degrees)
    ends = servo.gamma * np.array([servo.low, servo.high]) + servo.sigma
    if servo.unit in ("deg", "rad") and np.abs(ends).max() > MAX_ANGLE:
        message = f"sigma and gamma of `{servo.joint}` exceed the range of a rotating joint"
        reach = f"its generic range would be {ends.min():.4g} to {ends.max():.4g} rad"
        complain(Fault.LIMITS, servo.place, message, reach + degrees_hint(servo.sigma, MAX_ANGLE))


def _check_unique_joints(part: GenericPart, complain: ReportFinding) -> None:
    seen: set[str] = set()
    for servo in part.servos:
        if servo.joint and servo.qualified in seen:
            message = f"`{servo.qualified}` is mapped twice in `{part.name}`"
            complain(Fault.TWICE, servo.place, message, "")
        seen.add(servo.qualified)
    for held in part.fixed_joints:
        name = f"{held.part}/{held.joint}" if held.part else held.joint
        if name in seen:
            message = f"`{name}` cannot be held: `{part.name}` already uses it"
            complain(Fault.TWICE, held.place, message, "")
        seen.add(name)


def _check_fixed_joint_parts(part: GenericPart, complain: ReportFinding) -> None:
    """Fixed joints must be on a device part that also has servos of the generic part."""
    parts = {servo.part for servo in part.servos if servo.joint}
    for held in part.fixed_joints:
        if held.part not in parts:
            message = f"`{held.joint}` is held on `{held.part}`, where `{part.name}` has no servo"
            complain(
                Fault.FORM, held.place, message, f"it has servos on {', '.join(sorted(parts))}"
            )


def _check_taxel_positions(part: GenericPart, patch: Patch, complain: ReportFinding) -> None:
    """Taxels must lie near the cone of their limb, between its ends."""
    cone = part.limb(patch.limb).cone
    x, rho = patch.points[:, 0], np.hypot(patch.points[:, 1], patch.points[:, 2])
    beyond = np.maximum(np.maximum(cone.x0 - x, x - cone.x1), 0.0)
    away = np.hypot(beyond, rho - cone.radius(np.clip(x, cone.x0, cone.x1)))
    off = np.flatnonzero(away > MAX_SURFACE_DISTANCE)
    if len(off):
        worst = off[np.argmax(away[off])]
        plural, single = "taxels of `{}` are off their limb", "taxel of `{}` is off its limb"
        message = f"{len(off)} {(plural if len(off) > 1 else single).format(patch.name)}"
        far = f"taxel {patch.ids[worst]} is {1000 * away[worst]:.0f} mm from `{patch.limb}`"
        complain(Fault.OFF_BODY, patch.place, message, far)


def _check_unique_ids(robot: RobotDescription, complain: ReportFinding) -> None:
    owner: dict[int, str] = {}
    for part in robot.parts:
        for patch in part.patches:
            duplicates = [id_ for id_ in patch.ids if id_ in owner]
            if duplicates:
                first = duplicates[0]
                message = f"taxel id {first} of `{patch.name}` is also in `{owner[first]}`"
                count = "1 id occurs" if len(duplicates) == 1 else f"{len(duplicates)} ids occur"
                fix = f"{count} twice; change `first_id`"
                complain(Fault.TWICE, patch.place, message, fix)
            owner.update(dict.fromkeys(patch.ids, patch.name))


def _check_unique_patches(robot: RobotDescription, complain: ReportFinding) -> None:
    seen: set[str] = set()
    for patch in (patch for part in robot.parts for patch in part.patches):
        if patch.name in seen:
            message = f"there are two patches named `{patch.name}`"
            complain(Fault.TWICE, patch.place, message, "")
        seen.add(patch.name)


def _check_unique_bodies(robot: RobotDescription, complain: ReportFinding) -> None:
    """Each body must belong to one limb."""
    owner: dict[str, str] = {}
    for part in robot.parts:
        for limb in part.limbs:
            for body in (limb.body, *limb.covers):
                if body in owner:
                    message = f"the body `{body}` is covered by the skin of `{limb.name}`"
                    complain(Fault.TWICE, limb.place, f"{message} and of `{owner[body]}`", "")
                owner.setdefault(body, limb.name)


def _compare_servo(
    servo: Servo, joints: Mapping[str, tuple[float, float]], complain: ReportFinding
) -> None:
    if servo.joint not in joints:
        message = f"the robot has no joint `{servo.joint}`"
        complain(Fault.JOINT, servo.place, message, _suggestion(servo.joint, joints))
        return
    low, high = (end / UNITS[servo.unit] for end in joints[servo.joint])
    slack = 1e-3 * max(high - low, 1e-9)
    if servo.low < low - slack or servo.high > high + slack:
        message = f"the limits of `{servo.joint}` are wider than the robot's"
        has = f"the robot has {low:g} to {high:g} {servo.unit}"
        complain(Fault.LIMITS, servo.place, message, has)


def _compare_fixed_joint(
    held: FixedJoint, joints: Mapping[str, tuple[float, float]], complain: ReportFinding
) -> None:
    if held.joint not in joints:
        message = f"the robot has no joint `{held.joint}`"
        complain(Fault.JOINT, held.place, message, _suggestion(held.joint, joints))
        return
    low, high = joints[held.joint]
    if not low - 1e-3 <= held.position <= high + 1e-3:
        message = f"`{held.joint}` cannot be held at {held.position:g}, outside its limits"
        complain(Fault.LIMITS, held.place, message, f"the robot has {low:g} to {high:g}")


def _compare_limb(limb: Limb, bodies: frozenset[str], complain: ReportFinding) -> None:
    for body in (limb.body, *limb.covers):
        if body not in bodies:
            message = f"the limb `{limb.name}` is on `{body}`, which the robot does not have"
            complain(Fault.BODY, limb.place, message, _suggestion(body, bodies))


def _suggestion(word: str, known: Mapping[str, object] | frozenset[str]) -> str:
    matches = get_close_matches(word, sorted(known), n=1)
    return f"did you mean `{matches[0]}`?" if matches else ""
