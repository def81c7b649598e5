"""Judge a robot's description: what each value alone cannot tell.

In: `Robot` as read, and where known the joints of the real or simulated robot. Out: findings in
the reading, each at the line of the item it is about.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from difflib import get_close_matches

import numpy as np

from robocomp_dsl.tactile.description.located import Place, Reading
from robocomp_dsl.tactile.description.model import Part, Patch, Robot, Servo
from robocomp_dsl.tactile.errors import Finding

OFF_BODY = 0.015
"""A taxel further than this from its limb's cone is not on it [m]."""

WIDEST = 2 * np.pi
"""No joint of an arm turns further than this from the generic zero [rad]."""

Complain = Callable[[Place, str, str], None]


def check(robot: Robot, reading: Reading) -> None:
    """Everything that the description can contradict by itself."""
    complain = _into(reading)
    for part in robot.parts:
        for servo in part.servos:
            _servo(servo, complain)
        _joints_once(part, complain)
        for patch in part.patches:
            _on_body(part, patch, complain)
    _ids_once(robot, complain)


def check_joints(robot: Robot, limits: Mapping[str, tuple[float, float]]) -> None:
    """Against the robot's joints and their limits, in the unit of each servo.

    Raises `DescriptionError` for joints that do not exist and for limits or start poses that the
    robot does not have.
    """
    reading = Reading(robot.file)
    complain = _into(reading)
    for part in robot.parts:
        for servo in part.servos:
            if servo.joint:
                _exists(servo, limits, complain)
    reading.finish()


def check_bodies(robot: Robot, bodies: frozenset[str]) -> None:
    """Against the robot's bodies. Raises `DescriptionError` for limbs on none of them."""
    reading = Reading(robot.file)
    for part in robot.parts:
        for limb in part.limbs:
            for body in (limb.body, *limb.covers):
                if body not in bodies:
                    said = f"the limb `{limb.name}` is on `{body}`, which the robot does not have"
                    _into(reading)(limb.place, said, _near(body, bodies))
    reading.finish()


def _into(reading: Reading) -> Complain:
    def complain(place: Place, message: str, help: str) -> None:
        found = Finding(str(reading.file), place.line, place.column, message, help)
        reading.findings.append(found)

    return complain


def _servo(servo: Servo, complain: Complain) -> None:
    if not servo.joint:
        if not servo.low <= servo.sigma <= servo.high:
            said = f"sigma {servo.sigma:g} of the missing joint leaves its limits"
            complain(servo.place, said, f"they are {servo.low:g} to {servo.high:g}")
        return
    if servo.speed <= 0.0:
        complain(servo.place, f"the speed of `{servo.joint}` must be positive", "")
    if not servo.low <= servo.start <= servo.high:
        said = f"the start pose {servo.start:g} of `{servo.joint}` leaves its limits"
        complain(servo.place, said, f"they are {servo.low:g} to {servo.high:g} {servo.unit}")
    ends = servo.gamma * np.array([servo.low, servo.high]) + servo.sigma
    if servo.unit in ("deg", "rad") and np.abs(ends).max() > WIDEST:
        said = f"sigma and gamma of `{servo.joint}` leave the limits of a turning joint"
        complain(servo.place, said, f"its generic range is {ends.min():.3f} to {ends.max():.3f}")


def _joints_once(part: Part, complain: Complain) -> None:
    seen: set[str] = set()
    for servo in part.servos:
        if servo.joint and servo.qualified in seen:
            complain(servo.place, f"`{servo.qualified}` is mapped twice in `{part.name}`", "")
        seen.add(servo.qualified)


def _on_body(part: Part, patch: Patch, complain: Complain) -> None:
    """Taxels must lie near the cone of their limb, between its ends."""
    cone = part.limb(patch.limb).cone
    x, rho = patch.points[:, 0], np.hypot(patch.points[:, 1], patch.points[:, 2])
    beyond = np.maximum(np.maximum(cone.x0 - x, x - cone.x1), 0.0)
    away = np.hypot(beyond, rho - cone.radius(np.clip(x, cone.x0, cone.x1)))
    off = np.flatnonzero(away > OFF_BODY)
    if len(off):
        worst = off[np.argmax(away[off])]
        said = f"{len(off)} taxels of `{patch.name}` are off their body"
        far = f"taxel {patch.ids[worst]} is {1000 * away[worst]:.0f} mm from `{patch.limb}`"
        complain(patch.place, said, far)


def _ids_once(robot: Robot, complain: Complain) -> None:
    owner: dict[int, str] = {}
    for part in robot.parts:
        for patch in part.patches:
            twice = [one for one in patch.ids if one in owner]
            if twice:
                said = f"taxel id {twice[0]} of `{patch.name}` is also in `{owner[twice[0]]}`"
                complain(
                    patch.place, said, f"{len(twice)} ids occur twice; choose `first_id` apart"
                )
            owner.update(dict.fromkeys(patch.ids, patch.name))


def _exists(servo: Servo, limits: Mapping[str, tuple[float, float]], complain: Complain) -> None:
    if servo.joint not in limits:
        said = f"the robot has no joint `{servo.joint}`"
        complain(servo.place, said, _near(servo.joint, limits))
        return
    low, high = limits[servo.joint]
    slack = 1e-3 * max(high - low, 1e-9)
    if servo.low < low - slack or servo.high > high + slack:
        said = f"the limits of `{servo.joint}` are wider than the robot's"
        complain(servo.place, said, f"the robot has {low:g} to {high:g} {servo.unit}")


def _near(word: str, known: Mapping[str, object] | frozenset[str]) -> str:
    found = get_close_matches(word, list(known), n=1)
    return f"did you mean `{found[0]}`?" if found else ""
