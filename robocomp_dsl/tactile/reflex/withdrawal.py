"""Where a touched arm goes: away from the touch, by what its fields answer, and back.

In: responses of fields, where the arm is, its limits. Out: goals and speeds in generic angles. Pure
functions of data: nothing here reads a clock, remembers anything or knows a robot.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.reflex.law import Response, total_motion


@dataclass(frozen=True, slots=True, eq=False)
class ArmFacts:
    """What the reflex must know of its arm, all (n,): limits, speed limits and start pose.

    `available` tells which generic joints the robot has. Raises `ValueError` for facts that no arm
    can have.
    """

    low: Floats
    high: Floats
    speed: Floats
    start: Floats
    available: Bools

    def __post_init__(self) -> None:
        if len({len(one) for one in (self.low, self.high, self.speed, self.start)}) != 1:
            raise ValueError("limits, speeds and start pose differ in length")
        if self.available.shape != self.low.shape:
            raise ValueError("it does not say of every joint whether the robot has it")
        there = self.available
        numbers = np.concatenate(
            [one[there] for one in (self.low, self.high, self.speed, self.start)]
        )
        if not np.isfinite(numbers).all():
            raise ValueError("limits, speeds or start pose hold NaN or infinity")
        if (self.low > self.high)[there].any():
            raise ValueError("a lower limit lies above its upper limit")
        if (self.speed <= 0.0)[there].any():
            raise ValueError("a joint has no speed")

    @property
    def size(self) -> int:
        """Number of generic joints, n."""
        return len(self.low)

    def within(self, goal: Floats, pose: Floats) -> Floats:
        """`goal` (n,) within the limits; joints that the robot lacks stay as they are in `pose`."""
        kept: Floats = np.where(self.available, np.clip(goal, self.low, self.high), pose)
        return kept


@dataclass(frozen=True, slots=True, eq=False)
class Withdrawal:
    """One withdrawal, from `origin` (n,) where the arm was at `began` [s], to `goal` (n,).

    `strongest` has the strongest response so far of each field that answered, by its name.
    """

    began: float
    origin: Floats
    goal: Floats
    strongest: Mapping[str, Response]


def standing(pose: Floats, now: float) -> Withdrawal:
    """A withdrawal that begins at `pose` (n,) and `now` [s], and goes nowhere yet."""
    return Withdrawal(now, pose, pose, {})


def stronger(one: Withdrawal, responses: Iterable[Response], facts: ArmFacts) -> Withdrawal:
    """The same withdrawal with further responses.

    A touch that lasts, moves or splits must not push the arm again and again: each field counts
    with its strongest response, and the motions of several fields add up.
    """
    strongest = dict(one.strongest)
    for response in responses:
        known = strongest.get(response.field.name)
        if known is None or response.gain > known.gain:
            strongest[response.field.name] = response
    goal = one.origin + total_motion(strongest.values(), facts.size)
    return replace(one, goal=facts.within(goal, one.origin), strongest=strongest)


def news(before: Withdrawal, after: Withdrawal) -> list[Response]:
    """The responses in `after` that `before` does not have."""
    return [one for name, one in after.strongest.items() if before.strongest.get(name) is not one]


def furthest(one: Floats, other: Floats) -> float:
    """How far the joint that is furthest has to go between two poses (n,) [rad]."""
    return float(np.abs(one - other).max(initial=0.0))


def lasts(pose: Floats, goal: Floats, speed: Floats) -> float:
    """Seconds that a motion takes at `speed` (n,) [rad/s]; a joint without speed takes none."""
    way = np.abs(goal - pose)
    return float(np.divide(way, speed, out=np.zeros_like(way), where=speed > 0.0).max(initial=0.0))
