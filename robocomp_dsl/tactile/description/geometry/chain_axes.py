"""The check of a Denavit-Hartenberg chain against the model of the robot.

In: a part with a chain, and the robot's model. Out: the first servo whose axis differs, the end of
the chain if it differs from `tip`, and the largest deviation over random poses. Two chains whose
axes agree in one pose differ by a constant tool only (product of exponentials), so the first axis
that differs names the rows to look at.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robocomp_dsl.tactile.arm.chain import Chain
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.geometry.posed_model import PosedModel
from robocomp_dsl.tactile.description.model import GenericPart

POSITION_TOLERANCE = 0.002
"""Largest difference of positions [m]."""
ANGLE_TOLERANCE = float(np.radians(1.0))
"""Largest difference of directions [rad]."""
_POSES = 30
_SEED = 1


@dataclass(frozen=True, slots=True)
class ChainFault:
    """Where a chain leaves the model first: at generic index `servo`, None: at its end."""

    servo: int | None
    message: str
    help: str


@dataclass(frozen=True, slots=True, eq=False)
class _AxisError:
    """The difference of an axis [m, rad]."""

    distance: float
    angle: float

    @property
    def is_small(self) -> bool:
        return self.distance <= POSITION_TOLERANCE and self.angle <= ANGLE_TOLERANCE


def find_chain_fault(part: GenericPart, model: PosedModel) -> ChainFault | None:
    """The first difference between the chain of `part` and the model; None if they agree."""
    chain = part.generic_chain
    if chain is None or not _comparable(part, chain, model):
        return None
    start = part.start
    model.set_pose(part, start)
    errors = {base: _axis_errors(part, chain, model, base, start) for base in _bases(part, model)}
    best = min(errors, key=lambda base: _badness(errors[base]))
    deviation = _deviation(part, chain, model, best)
    wrong = next((i for i, error in errors[best].items() if not error.is_small), None)
    if wrong is not None:
        error, joint = errors[best][wrong], part.servos[wrong].joint
        message = (
            f"the chain leaves the model at servo {wrong}: seen from `{best}`, its axis is"
            f" {1000 * error.distance:.1f} mm and {np.degrees(error.angle):.1f} deg from `{joint}`"
        )
        return ChainFault(wrong, message, f"over the limits the hand is off by up to {deviation}")
    return _tip_fault(part, chain, model, best, start)


def _comparable(part: GenericPart, chain: Chain, model: PosedModel) -> bool:
    """Whether every joint of the chain rotates in the model, and all are on one line of bodies."""
    used = _used(part, chain)
    if not used:
        return False
    joints = [part.servos[i].joint for i in used]
    above = model.joints_above(model.body_of(joints[-1]))
    return all(model.joint(joint).rotates and joint in above for joint in joints)


def _used(part: GenericPart, chain: Chain) -> list[int]:
    """The servos of the rows, in their order."""
    rows = [row.joint for row in chain.rows if row.joint is not None]
    return [index for index in rows if part.servos[index].joint]


def _bases(part: GenericPart, model: PosedModel) -> tuple[str, ...]:
    first = next(servo.joint for servo in part.servos if servo.joint)
    return model.bodies_above(model.body_of(first))


def _axis_errors(
    part: GenericPart, chain: Chain, model: PosedModel, base: str, angles: Floats
) -> dict[int, _AxisError]:
    """The difference of each axis of the chain, seen from the body `base`, in chain order."""
    pose = model.pose(base)
    assert pose is not None  # noqa: S101 - `base` is a body of the model
    tip, jacobian = chain.pose_and_jacobian(angles)
    errors = {}
    for index in _used(part, chain):
        turn, speed = jacobian[3:, index], jacobian[:3, index]
        point = tip[:3, 3] + np.cross(turn, speed)
        axis = model.joint(part.servos[index].joint)
        direction = pose[:3, :3].T @ axis.direction * np.sign(part.servos[index].gamma)
        offset = pose[:3, :3].T @ (axis.point - pose[:3, 3]) - point
        across = offset - direction * (direction @ offset)
        angle = float(np.arctan2(np.linalg.norm(np.cross(turn, direction)), turn @ direction))
        errors[index] = _AxisError(float(np.linalg.norm(across)), angle)
    return errors


def _badness(errors: dict[int, _AxisError]) -> tuple[int, float]:
    """Fewest axes after the first wrong one, then the smallest differences."""
    wrong = [k for k, error in enumerate(errors.values()) if not error.is_small]
    total = sum(error.distance + 0.1 * error.angle for error in errors.values())
    return len(errors) - (wrong[0] if wrong else len(errors)), total


def _tip_fault(
    part: GenericPart, chain: Chain, model: PosedModel, base: str, start: Floats
) -> ChainFault | None:
    """The end of the chain away from the point of the model that `tip` names."""
    if not part.tip:
        return None
    frame, tip = model.pose(base), model.pose(part.tip)
    if frame is None or tip is None:
        return None
    expected = frame[:3, :3].T @ (tip[:3, 3] - frame[:3, 3])
    distance = float(np.linalg.norm(chain.pose(start)[:3, 3] - expected))
    if distance <= POSITION_TOLERANCE:
        return None
    message = f"the chain ends {1000 * distance:.1f} mm from `{part.tip}` of the model"
    return ChainFault(None, message, "all its axes are right: change the last row, or `tool`")


def _deviation(part: GenericPart, chain: Chain, model: PosedModel, base: str) -> str:
    """The largest deviation over random poses within the limits, up to a constant tool.

    The tool is that of the start pose. Afterwards the model is at the start again.
    """
    mapping = part.mapping
    low, high = mapping.limits
    last = model.body_of(part.servos[_used(part, chain)[-1]].joint)
    tool = np.linalg.inv(_seen(model, base, last)) @ chain.pose(part.start)
    random = np.random.default_rng(_SEED)
    distance = angle = 0.0
    for _ in range(_POSES):
        angles = np.where(mapping.available, random.uniform(low, high), mapping.sigma)
        model.set_pose(part, angles)
        expected, actual = _seen(model, base, last) @ tool, chain.pose(angles)
        distance = max(distance, float(np.linalg.norm(expected[:3, 3] - actual[:3, 3])))
        cosine = (np.trace(expected[:3, :3].T @ actual[:3, :3]) - 1.0) / 2.0
        angle = max(angle, float(np.arccos(np.clip(cosine, -1.0, 1.0))))
    model.set_pose(part, part.start)
    return f"{1000 * distance:.0f} mm and {np.degrees(angle):.0f} deg"


def _seen(model: PosedModel, base: str, body: str) -> Floats:
    """The pose (4, 4) of `body` in the frame of `base`."""
    frame, pose = model.pose(base), model.pose(body)
    assert frame is not None  # noqa: S101 - both are bodies of the model
    assert pose is not None  # noqa: S101
    seen: Floats = np.linalg.inv(frame) @ pose
    return seen
