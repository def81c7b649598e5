"""The next command of a wandering robot: a pure function of one scan.

In: a scan, the time, the current action, the thresholds. Out: a command, and the new action.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


class Thresholds(Protocol):
    """The thresholds; the component's parameters have the same names."""

    @property
    def threshold(self) -> float:
        """Distance (mm) below which something is an obstacle."""

    @property
    def front(self) -> float:
        """Half the width of the front sector, rad."""

    @property
    def advance(self) -> float:
        """mm/s."""

    @property
    def turn(self) -> float:
        """rad/s."""

    @property
    def turn_min(self) -> float:
        """ms."""

    @property
    def turn_max(self) -> float:
        """ms."""

    @property
    def side(self) -> str:
        """`freer` or `random`."""


@dataclass(frozen=True, slots=True)
class Turning:
    """Turning on the spot: `sense` 1 to the right, -1 to the left, at least until `until` (s)."""

    sense: int
    until: float


@dataclass(frozen=True, slots=True)
class Decision:
    """`adv` in mm/s and `rot` in rad/s; `turning` is None while it goes ahead."""

    adv: float
    rot: float
    turning: Turning | None
    nearest: float


def decide(
    angles: NDArray[np.float32],
    distances: NDArray[np.float32],
    now: float,
    turning: Turning | None,
    *,
    it: Thresholds,
    chance: random.Random,
) -> Decision:
    """Ahead while the front sector is free; else turn on the spot until it is free again.

    `angles` (rad, positive to the right) and `distances` (mm) have one entry per ray, `now` is in
    s. The side of a turn stays the same until it ends; else the robot would oscillate in corners.
    """
    sector = distances[np.abs(angles) <= it.front]
    nearest = float(sector.min()) if len(sector) else float("inf")
    blocked = nearest < it.threshold
    if turning and (blocked or now < turning.until):
        return Decision(0.0, it.turn * turning.sense, turning, nearest)
    if not blocked:
        return Decision(it.advance, 0.0, None, nearest)
    longest = max(it.turn_min, it.turn_max)
    lasting = chance.uniform(it.turn_min, longest) / 1000
    new_turn = Turning(_side(angles, distances, it.side, chance), now + lasting)
    return Decision(0.0, it.turn * new_turn.sense, new_turn, nearest)


def _side(
    angles: NDArray[np.float32], distances: NDArray[np.float32], side: str, chance: random.Random
) -> int:
    if side == "random" or not len(angles):
        return chance.choice((-1, 1))
    right, left = distances[angles > 0], distances[angles < 0]
    return 1 if right.sum() >= left.sum() else -1
