"""The withdrawal of a touched arm: goals and speeds from the responses of receptive fields.

In: responses, the pose of the arm, its limits. Out: goals and speeds in generic angles. Pure
functions of data, without clock, state or robot.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.reflex.law import Response, total_motion

_SHORTEST = 1e-9


class LimitCause(Enum):
    """Why a withdrawal is smaller than its touch requires."""

    JOINT_LIMITS = "the joints that would move away are at their limits"
    OWN_BODY = "the arm would press against the robot itself"
    NO_DIRECTION = "no joint moves the touched place away"


@dataclass(frozen=True, slots=True, eq=False)
class ArmProperties:
    """The properties of an arm, all (n,): limits [rad], speed limits [rad/s] and start pose [rad].

    `available` marks the generic joints that the robot has. Raises `ValueError` for inconsistent
    properties.
    """

    low: Floats
    high: Floats
    speed: Floats
    start: Floats
    available: Bools

    def __post_init__(self) -> None:
        if len({len(values) for values in (self.low, self.high, self.speed, self.start)}) != 1:
            raise ValueError("limits, speeds and start pose differ in length")
        if self.available.shape != self.low.shape:
            raise ValueError("`available` needs one entry per joint")
        there = self.available
        numbers = np.concatenate(
            [values[there] for values in (self.low, self.high, self.speed, self.start)]
        )
        if not np.isfinite(numbers).all():
            raise ValueError("limits, speeds or start pose hold NaN or infinity")
        if (self.low > self.high)[there].any():
            raise ValueError("a lower limit is above its upper limit")
        if (self.speed <= 0.0)[there].any():
            raise ValueError("a joint has a speed limit of 0 or less")

    @property
    def size(self) -> int:
        """Number of generic joints, n."""
        return len(self.low)

    def within(self, goal: Floats, pose: Floats) -> Floats:
        """`goal` (n,) clipped to the limits; missing joints keep their value of `pose`."""
        limited: Floats = np.where(self.available, np.clip(goal, self.low, self.high), pose)
        return limited


@dataclass(frozen=True, slots=True, eq=False)
class Withdrawal:
    """A withdrawal from `origin` (n,), the pose at `began` [s], to `goal` (n,).

    `strongest` holds the strongest response so far of each field, by its name; `felt_at` the pose
    (n,) at its first response. `limit` says what made the latest goal smaller.
    """

    began: float
    origin: Floats
    goal: Floats
    strongest: Mapping[str, Response]
    felt_at: Mapping[str, Floats] = field(default_factory=dict)
    limit: LimitCause | None = None


def initial(pose: Floats, now: float) -> Withdrawal:
    """A withdrawal that begins at `pose` (n,) and `now` [s], without any motion yet."""
    return Withdrawal(now, pose, pose, {})


def add_responses(
    withdrawal: Withdrawal, responses: Iterable[Response], arm: ArmProperties
) -> Withdrawal:
    """The withdrawal with further responses added.

    A touch that lasts, moves or splits must not move the arm repeatedly: each field contributes
    its strongest response only, and the motions of several fields are added.
    """
    strongest = dict(withdrawal.strongest)
    for response in responses:
        known = strongest.get(response.field.name)
        if known is None or response.gain > known.gain:
            strongest[response.field.name] = response
    goal = withdrawal.origin + total_motion(strongest.values(), arm.size)
    return replace(withdrawal, goal=arm.within(goal, withdrawal.origin), strongest=strongest)


def new_responses(before: Withdrawal, after: Withdrawal) -> list[Response]:
    """The responses of `after` that are not in `before`."""
    return [
        response
        for name, response in after.strongest.items()
        if before.strongest.get(name) is not response
    ]


def max_joint_distance(pose: Floats, other: Floats) -> float:
    """The largest distance of a joint between two poses (n,) [rad]."""
    return float(np.abs(pose - other).max(initial=0.0))


def synchronised(pose: Floats, goal: Floats, speed: Floats) -> Floats:
    """Speeds (n,) [rad/s] with which all joints arrive together, none faster than `speed` (n,).

    The arm then moves on the straight way in joint space. Joints without motion have `speed`.
    """
    distance, seconds = np.abs(goal - pose), duration(pose, goal, speed)
    moves = (distance > 0.0) & (seconds > 0.0)
    together: Floats = np.where(moves, distance / max(seconds, _SHORTEST), speed)
    return together


def duration(pose: Floats, goal: Floats, speed: Floats) -> float:
    """Duration [s] of a motion at `speed` (n,) [rad/s]; joints with speed 0 are ignored."""
    distance = np.abs(goal - pose)
    return float(
        np.divide(distance, speed, out=np.zeros_like(distance), where=speed > 0.0).max(initial=0.0)
    )
