"""The directions of the generic arm, and the check of gamma and sigma by forward kinematics.

In: a part with the five servos of an arm, and the robot's model. Out: the first servo whose joint
does not move the arm as its generic index says; later servos follow from it. At generic zero the
arm hangs straight beside the body, and the flexed forearm points forward.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.geometry.posed_model import JointAxis, PosedModel
from robocomp_dsl.tactile.description.model import GENERIC_ARM, GenericPart, RobotDescription

PITCH, ROLL, YAW, ELBOW, TWIST = range(len(GENERIC_ARM))

_EFFECTS = (
    "raises the hanging arm forward",
    "moves the hanging arm away from the body",
    "turns the flexed forearm inward",
    "flexes the elbow, the forearm forward",
    "turns the flexed forearm about itself, its upper side inward",
)
"""What a positive generic angle does, by index."""

_AXIS_TOLERANCE = np.radians(40)
_REST_TOLERANCE = np.radians(35)
_LEFT = re.compile(r"(?:^|[^a-z])l(?:eft)?(?![a-z])", re.IGNORECASE)
_RIGHT = re.compile(r"(?:^|[^a-z])r(?:ight)?(?![a-z])", re.IGNORECASE)


@dataclass(frozen=True, slots=True, eq=False)
class ArmDirections:
    """Directions (3,) of the robot that carries the arm, in the world of its model."""

    up: Floats
    outward: Floats
    forward: Floats

    @property
    def axes(self) -> Floats:
        """The axes (5, 3) of positive generic angles at generic zero."""
        down = -self.up
        inward = np.cross(self.forward, -self.outward)
        lift = np.cross(down, self.forward)
        return np.stack((lift, np.cross(down, self.outward), inward, lift, inward))

    def name(self, direction: Floats) -> str:
        """The nearest direction in words."""
        words = {"upward": self.up, "outward": self.outward, "forward": self.forward}
        words |= {"downward": -self.up, "inward": -self.outward, "backward": -self.forward}
        return max(words, key=lambda word: float(words[word] @ direction))


@dataclass(frozen=True, slots=True)
class ServoFault:
    """A servo whose gamma, sigma or joint is wrong; `index` is its generic index."""

    index: int
    message: str
    help: str


def is_arm(part: GenericPart) -> bool:
    """Whether the part has the servos of the generic arm, at least four with rotating joints."""
    present = sum(bool(servo.joint) for servo in part.servos)
    turning = all(servo.unit in ("deg", "rad") for servo in part.servos)
    return len(part.servos) == len(GENERIC_ARM) and present >= TWIST and turning


def directions(robot: RobotDescription, part: GenericPart, model: PosedModel) -> ArmDirections:
    """The directions for `part`, which `model` holds at generic zero.

    Outward is from the trunk, or from the shoulder of the robot's other arm, to the shoulder. The
    side is that of the part's name; without one, forward is where servo 0 moves the arm.
    """
    up = model.up
    shoulder = _first_joint(part, model)
    offset = shoulder.point - _trunk(robot, part, model)
    outward = offset - up * (up @ offset)
    outward /= np.linalg.norm(outward) or 1.0
    forward = np.cross(outward, up)
    side = _side(part.name)
    if side == 0:
        moved = np.cross(_signed(part, 0, shoulder), -up)
        side = 1 if moved @ forward >= 0.0 else -1
    return ArmDirections(up, outward, forward * side)


def find_servo_fault(part: GenericPart, model: PosedModel, way: ArmDirections) -> ServoFault | None:
    """The first wrong servo of an arm; `model` holds it at generic zero. None if all are right."""
    fault = _find_servo_fault(part, model, way)
    if fault is None or not _side(part.name):
        return fault
    mirrored = ArmDirections(way.up, way.outward, -way.forward)
    if _find_servo_fault(part, model, mirrored):
        return fault
    first = next(i for i, servo in enumerate(part.servos) if servo.joint)
    side, other = ("left", "right") if _side(part.name) > 0 else ("right", "left")
    message = (
        f"`{part.name}` is a {side} arm by its name, but its joints are those of a {other} arm"
    )
    help_text = "swap the joints of the two arms, or the names of the parts"
    return ServoFault(first, message, help_text)


def _find_servo_fault(
    part: GenericPart, model: PosedModel, way: ArmDirections
) -> ServoFault | None:
    for index, servo in enumerate(part.servos):
        factor = abs(float(part.mapping.gamma_si[index]))
        if servo.joint and not 0.99 < factor < 1.01:
            message = f"gamma of `{servo.joint}` turns 1 rad of the joint into {factor:.4g} rad"
            right = np.sign(servo.gamma) * part.mapping.to_si[index]
            return ServoFault(index, message, f"for a joint in {servo.unit} it is {right:.9g}")
    if fault := _order_fault(part, model):
        return fault
    for index in range(len(part.servos)):
        fault = _rest_fault(index, part, model, way) or _axis_fault(index, part, model, way)
        if fault:
            return fault
    return None


def _order_fault(part: GenericPart, model: PosedModel) -> ServoFault | None:
    """A joint of the shoulder or elbow that does not carry a later one; shoulders differ inside."""
    present = [index for index, servo in enumerate(part.servos) if servo.joint]
    for index, following in combinations(present, 2):
        if following < ELBOW:
            continue
        joint, carried = part.servos[index].joint, part.servos[following].joint
        if joint in model.joints_above(model.body_of(carried)):
            continue
        relation = "does not carry"
        if carried in model.joints_above(model.body_of(joint)):
            relation = "is carried by"
        message = (
            f"`{joint}` cannot have index {index}: it {relation} `{carried}`, index {following}"
        )
        return ServoFault(index, message, f"the order is {', '.join(GENERIC_ARM)}")
    return None


def _axis_fault(
    index: int, part: GenericPart, model: PosedModel, way: ArmDirections
) -> ServoFault | None:
    """A joint that does not turn about the axis of its index, or turns the other way."""
    servo = part.servos[index]
    if not servo.joint:
        return None
    axis = _signed(part, index, model.joint(servo.joint))
    expected = way.axes[index]
    along = float(axis @ expected)
    if along >= np.cos(_AXIS_TOLERANCE):
        return None
    effect = f"index {index}, {GENERIC_ARM[index].replace('_', ' ')}: + {_EFFECTS[index]}"
    if along > -np.cos(_AXIS_TOLERANCE):
        return _other_axis(index, part, axis, way, effect)
    if index == ELBOW and _mostly_positive(part, index) and part.servos[YAW].joint:
        return _sigma_fault(YAW, part, "the flexed forearm points backward", "180 deg")
    message = f"gamma of `{servo.joint}` has the wrong sign: + moves the arm the other way"
    return ServoFault(index, message, f"{effect}; write gamma {-servo.gamma:.9g}")


def _other_axis(
    index: int, part: GenericPart, axis: Floats, way: ArmDirections, effect: str
) -> ServoFault:
    """The joint turns about another axis: the joint is wrong, or an earlier sigma."""
    upper_arm = -way.up
    if index == ELBOW and abs(axis @ upper_arm) < np.cos(_AXIS_TOLERANCE) and _yaws(part):
        points = way.name(np.cross(axis, upper_arm))
        return _sigma_fault(YAW, part, f"the flexed forearm points {points}", "90 deg")
    motion = way.name(np.cross(axis, upper_arm if index <= ROLL or index == ELBOW else way.forward))
    moved = "hanging arm" if index <= ROLL else "forearm"
    message = f"`{part.servos[index].joint}` is not the joint of generic index {index}"
    if abs(axis @ (upper_arm if index <= ROLL or index == ELBOW else way.forward)) > 0.8:
        return ServoFault(index, f"{message}: it only turns the {moved} about itself", effect)
    return ServoFault(index, f"{message}: it moves the {moved} {motion}", effect)


def _rest_fault(
    index: int, part: GenericPart, model: PosedModel, way: ArmDirections
) -> ServoFault | None:
    """A sigma with which the arm does not hang straight at generic zero.

    The direction of the upper arm is that of pitch and roll, so it is looked at before the axis of
    the roll joint, which pitch moves.
    """
    names = [servo.joint for servo in part.servos]
    if not names[ELBOW] or index not in (ROLL, ELBOW + 1):
        return None
    elbow = model.joint(names[ELBOW]).point
    if index == ROLL and names[ROLL]:
        shoulder = model.joint(names[ROLL])
        upper_arm = _unit(elbow - shoulder.point)
        if upper_arm @ -way.up >= np.cos(_REST_TOLERANCE):
            return None
        wrong = PITCH if abs(shoulder.direction @ way.forward) < np.cos(_AXIS_TOLERANCE) else ROLL
        hangs = f"the upper arm points {way.name(upper_arm)} instead of downward"
        return _sigma_fault(wrong, part, hangs, _degrees(upper_arm, -way.up))
    if index == ELBOW + 1:
        forearm = _unit(model.centre(model.body_of(names[ELBOW])) - elbow)
        if forearm @ -way.up >= np.cos(_REST_TOLERANCE):
            return None
        bent = f"the forearm points {way.name(forearm)}, the elbow is not straight"
        return _sigma_fault(ELBOW, part, bent, _degrees(forearm, -way.up))
    return None


def _sigma_fault(index: int, part: GenericPart, effect: str, angle: str) -> ServoFault:
    joint = part.servos[index].joint
    message = f"sigma of `{joint}` is wrong by about {angle}: at generic zero {effect}"
    rest = "at generic zero the arm hangs straight, and the flexed forearm points forward"
    return ServoFault(index, message, rest)


def _degrees(first: Floats, second: Floats) -> str:
    return f"{np.degrees(np.arccos(np.clip(first @ second, -1.0, 1.0))):.0f} deg"


def _yaws(part: GenericPart) -> bool:
    return bool(part.servos[YAW].joint)


def _mostly_positive(part: GenericPart, index: int) -> bool:
    low, high = part.mapping.limits
    return bool(low[index] + high[index] >= 0.0)


def _signed(part: GenericPart, index: int, axis: JointAxis) -> Floats:
    """The axis of a positive generic angle."""
    signed: Floats = axis.direction * np.sign(part.servos[index].gamma)
    return signed


def _first_joint(part: GenericPart, model: PosedModel) -> JointAxis:
    return model.joint(next(servo.joint for servo in part.servos if servo.joint))


def _trunk(robot: RobotDescription, part: GenericPart, model: PosedModel) -> Floats:
    """A point in the sagittal plane of the robot."""
    first = _first_joint(part, model)
    base = model.bodies_above(model.body_of(first.joint))[0]
    for other in robot.parts:
        if other.name == part.name or not is_arm(other):
            continue
        opposite = _first_joint(other, model)
        beside = model.bodies_above(model.body_of(opposite.joint))[0]
        if beside == base and np.linalg.norm(opposite.point - first.point) > 1e-3:
            return (first.point + opposite.point) / 2
    return model.rest_centre(model.body_of(first.joint))


def _side(name: str) -> int:
    """1 for a left arm, -1 for a right arm, 0 if the name does not say it."""
    left, right = _LEFT.search(name), _RIGHT.search(name)
    if bool(left) == bool(right):
        return 0
    return 1 if left else -1


def _unit(vector: Floats) -> Floats:
    unit: Floats = vector / (float(np.linalg.norm(vector)) or 1.0)
    return unit
