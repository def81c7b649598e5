"""Presses one place after the other with a finger; waits for the withdrawal and the return.

In: a `Stage` with a finger and an arm, and a `Body` that locates places. Out: the time of each
press. All waiting is in simulated time.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np
from body import Body
from path_planner import plan_path
from recording import Floats, Place, Press


@dataclass(frozen=True, slots=True)
class Manner:
    """Motion of the finger: lengths in m, times in s, speed in m/s.

    It stops `off` before the skin, moves to `near`, then `deep` into the initial position of the
    skin within `push`; it stays for `stay`, and leaves once the skin felt nothing for `free`.
    """

    off: float = 0.035
    near: float = 0.003
    deep: float = 0.004
    push: float = 0.1
    stay: float = 1.5
    free: float = 0.1
    speed: float = 0.25


PLAIN = Manner()
_SHORTEST = 0.15  # s: minimum duration of a finger motion
_SETTLE = 0.15  # s: settling time after a motion


class Stage(Protocol):
    """The demo's view of a robot, and its control of the finger."""

    def now(self) -> float:
        """Simulated time in s."""

    def arm(self) -> Floats:
        """Generic angles of the arm, (5,)."""

    def finger(self) -> Floats:
        """The finger's joint positions, (3,)."""

    def move_finger(self, joints: Floats, seconds: float) -> None:
        """Move the finger so that it arrives after some seconds; returns immediately."""

    def free_since(self) -> float:
        """Time since which the arm's skin has felt nothing; infinite while it feels something."""

    def wait_until_calm(self) -> None:
        """Wait until the reflex is watching and the arm is at rest."""

    def wait(self, seconds: float) -> None:
        """Wait for simulated time."""


def press(stage: Stage, body: Body, place: Place, manner: Manner = PLAIN) -> Press:
    """Press one place. Raises `NoPath`."""
    stage.wait_until_calm()
    body.pose(arm=stage.arm(), finger=stage.finger())
    skin, out = body.touching(place), body.outward(place)
    here = body.finger_point
    _follow(
        stage, body, [here, *plan_path(body.clearance, here, skin + manner.off * out)], manner.speed
    )
    _go(stage, body, skin + manner.near * out, _SHORTEST)
    stage.wait(_SHORTEST + _SETTLE)
    began = stage.now()
    _go(stage, body, skin - manner.deep * out, manner.push)
    stage.wait(manner.push)
    while stage.now() - max(stage.free_since(), began + manner.push) < manner.free:
        if not 0.0 <= stage.now() - began <= manner.stay:
            break
        stage.wait(0.02)
    _go(stage, body, skin + manner.off * out, _SHORTEST)
    stage.wait(_SHORTEST + _SETTLE)
    return Press(place.name, began, stage.now())


def park(stage: Stage, body: Body, home: Floats, manner: Manner = PLAIN) -> None:
    """Return the finger to its initial position, out of the robot's reach. Raises `NoPath`."""
    stage.wait_until_calm()
    body.pose(arm=stage.arm(), finger=stage.finger())
    here = body.finger_point
    _follow(stage, body, [here, *plan_path(body.clearance, here, home)], manner.speed)


def _follow(stage: Stage, body: Body, points: list[Floats], speed: float) -> None:
    for before, after in pairwise(points):
        seconds = max(_SHORTEST, float(np.linalg.norm(after - before)) / speed)
        _go(stage, body, after, seconds)
        stage.wait(seconds + _SETTLE)


def _go(stage: Stage, body: Body, point: Floats, seconds: float) -> None:
    stage.move_finger(body.finger_joints(point), seconds)
