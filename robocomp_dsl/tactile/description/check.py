"""Judge a robot's description: what each value alone cannot tell.

In: `Robot` as read, and where known the joints and bodies of the real or simulated robot. Out:
findings in the reading, each at the line of the item it is about.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

import numpy as np

from robocomp_dsl.tactile.description.located import UNITS, Place, Reading, meant_in_degrees
from robocomp_dsl.tactile.description.model import Held, Limb, Part, Patch, Robot, Servo
from robocomp_dsl.tactile.errors import Fault, Finding

OFF_BODY = 0.015
"""A taxel further than this from its limb's cone is not on it [m]."""

WIDEST = 2 * np.pi
"""No joint of an arm turns further than this from the generic zero [rad]."""

Complain = Callable[[Fault, Place, str, str], None]


@dataclass(frozen=True, slots=True)
class Facts:
    """What a model says of its robot: limits of the joints [rad, m], and names of the bodies."""

    joints: Mapping[str, tuple[float, float]]
    bodies: frozenset[str]


def check(robot: Robot, reading: Reading) -> None:
    """Everything that the description can contradict by itself."""
    complain = _into(reading)
    for part in robot.parts:
        for servo in part.servos:
            _servo(servo, complain)
        _joints_once(part, complain)
        _held_beside(part, complain)
        for patch in part.patches:
            _on_body(part, patch, complain)
    _ids_once(robot, complain)
    _patches_once(robot, complain)
    _bodies_once(robot, complain)


def compare(robot: Robot, facts: Facts) -> None:
    """Against the robot's joints and bodies.

    Raises `DescriptionError` for joints and bodies that do not exist, and for limits that are wider
    than the robot's.
    """
    reading = Reading(robot.file)
    complain = _into(reading)
    for part in robot.parts:
        for servo in part.servos:
            if servo.joint:
                _exists(servo, facts.joints, complain)
        for held in part.held:
            _holds(held, facts.joints, complain)
        for limb in part.limbs:
            _carried(limb, facts.bodies, complain)
    reading.finish()


def _into(reading: Reading) -> Complain:
    def complain(fault: Fault, place: Place, message: str, help: str) -> None:
        found = Finding(str(reading.file), place.line, place.column, message, help, fault)
        reading.findings.append(found)

    return complain


def _servo(servo: Servo, complain: Complain) -> None:
    if not servo.joint:
        if not servo.low <= servo.sigma <= servo.high:
            said = f"sigma {servo.sigma:g} of the missing joint leaves its limits"
            allowed = f"they are {servo.low:g} to {servo.high:g} {servo.unit}"
            complain(Fault.LIMITS, servo.place, said, allowed)
        return
    if servo.speed <= 0.0:
        complain(Fault.FORM, servo.place, f"the speed of `{servo.joint}` must be positive", "")
    for name, value in (("stiffness", servo.stiffness), ("damping", servo.damping)):
        if value < 0.0:
            said = f"the {name} of `{servo.joint}` must not be negative"
            complain(Fault.FORM, servo.place, said, "")
    if not servo.low <= servo.start <= servo.high:
        said = f"the start pose {servo.start:g} of `{servo.joint}` leaves its limits"
        allowed = f"they are {servo.low:g} to {servo.high:g} {servo.unit}"
        degrees = "" if servo.unit == "deg" else meant_in_degrees(servo.start, servo.high)
        complain(Fault.LIMITS, servo.place, said, allowed + degrees)
    ends = servo.gamma * np.array([servo.low, servo.high]) + servo.sigma
    if servo.unit in ("deg", "rad") and np.abs(ends).max() > WIDEST:
        said = f"sigma and gamma of `{servo.joint}` leave the limits of a turning joint"
        reach = f"its generic angles would be {ends.min():.4g} to {ends.max():.4g} rad"
        complain(Fault.LIMITS, servo.place, said, reach + meant_in_degrees(servo.sigma, WIDEST))


def _joints_once(part: Part, complain: Complain) -> None:
    seen: set[str] = set()
    for servo in part.servos:
        if servo.joint and servo.qualified in seen:
            said = f"`{servo.qualified}` is mapped twice in `{part.name}`"
            complain(Fault.TWICE, servo.place, said, "")
        seen.add(servo.qualified)
    for held in part.held:
        name = f"{held.part}/{held.joint}" if held.part else held.joint
        if name in seen:
            said = f"`{name}` cannot be held: it is there already in `{part.name}`"
            complain(Fault.TWICE, held.place, said, "")
        seen.add(name)


def _held_beside(part: Part, complain: Complain) -> None:
    """Who moves the servos reaches the held joints, too."""
    parts = {servo.part for servo in part.servos if servo.joint}
    for held in part.held:
        if held.part not in parts:
            said = f"`{held.joint}` is held on `{held.part}`, where `{part.name}` has no servo"
            complain(Fault.FORM, held.place, said, f"it has some on {', '.join(sorted(parts))}")


def _on_body(part: Part, patch: Patch, complain: Complain) -> None:
    """Taxels must lie near the cone of their limb, between its ends."""
    cone = part.limb(patch.limb).cone
    x, rho = patch.points[:, 0], np.hypot(patch.points[:, 1], patch.points[:, 2])
    beyond = np.maximum(np.maximum(cone.x0 - x, x - cone.x1), 0.0)
    away = np.hypot(beyond, rho - cone.radius(np.clip(x, cone.x0, cone.x1)))
    off = np.flatnonzero(away > OFF_BODY)
    if len(off):
        worst = off[np.argmax(away[off])]
        many, one = "taxels of `{}` are off their body", "taxel of `{}` is off its body"
        said = f"{len(off)} {(many if len(off) > 1 else one).format(patch.name)}"
        far = f"taxel {patch.ids[worst]} is {1000 * away[worst]:.0f} mm from `{patch.limb}`"
        complain(Fault.OFF_BODY, patch.place, said, far)


def _ids_once(robot: Robot, complain: Complain) -> None:
    owner: dict[int, str] = {}
    for part in robot.parts:
        for patch in part.patches:
            twice = [one for one in patch.ids if one in owner]
            if twice:
                said = f"taxel id {twice[0]} of `{patch.name}` is also in `{owner[twice[0]]}`"
                count = "1 id occurs" if len(twice) == 1 else f"{len(twice)} ids occur"
                way = f"{count} twice; choose `first_id` apart"
                complain(Fault.TWICE, patch.place, said, way)
            owner.update(dict.fromkeys(patch.ids, patch.name))


def _patches_once(robot: Robot, complain: Complain) -> None:
    seen: set[str] = set()
    for patch in (patch for part in robot.parts for patch in part.patches):
        if patch.name in seen:
            said = f"there are two patches of the name `{patch.name}`"
            complain(Fault.TWICE, patch.place, said, "")
        seen.add(patch.name)


def _bodies_once(robot: Robot, complain: Complain) -> None:
    """What touches a body is felt by one limb."""
    owner: dict[str, str] = {}
    for part in robot.parts:
        for limb in part.limbs:
            for body in (limb.body, *limb.covers):
                if body in owner:
                    said = f"the body `{body}` is below the skin of `{limb.name}`"
                    complain(Fault.TWICE, limb.place, f"{said} and of `{owner[body]}`", "")
                owner.setdefault(body, limb.name)


def _exists(servo: Servo, joints: Mapping[str, tuple[float, float]], complain: Complain) -> None:
    if servo.joint not in joints:
        said = f"the robot has no joint `{servo.joint}`"
        complain(Fault.JOINT, servo.place, said, _near(servo.joint, joints))
        return
    low, high = (end / UNITS[servo.unit] for end in joints[servo.joint])
    slack = 1e-3 * max(high - low, 1e-9)
    if servo.low < low - slack or servo.high > high + slack:
        said = f"the limits of `{servo.joint}` are wider than the robot's"
        has = f"the robot has {low:g} to {high:g} {servo.unit}"
        complain(Fault.LIMITS, servo.place, said, has)


def _holds(held: Held, joints: Mapping[str, tuple[float, float]], complain: Complain) -> None:
    if held.joint not in joints:
        said = f"the robot has no joint `{held.joint}`"
        complain(Fault.JOINT, held.place, said, _near(held.joint, joints))
        return
    low, high = joints[held.joint]
    if not low - 1e-3 <= held.at <= high + 1e-3:
        said = f"`{held.joint}` cannot be held at {held.at:g}, outside of its limits"
        complain(Fault.LIMITS, held.place, said, f"the robot has {low:g} to {high:g}")


def _carried(limb: Limb, bodies: frozenset[str], complain: Complain) -> None:
    for body in (limb.body, *limb.covers):
        if body not in bodies:
            said = f"the limb `{limb.name}` is on `{body}`, which the robot does not have"
            complain(Fault.BODY, limb.place, said, _near(body, bodies))


def _near(word: str, known: Mapping[str, object] | frozenset[str]) -> str:
    found = get_close_matches(word, sorted(known), n=1)
    return f"did you mean `{found[0]}`?" if found else ""
