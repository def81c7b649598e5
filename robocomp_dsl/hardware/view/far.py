"""A hand on a world that runs elsewhere: its time, its joints, its nodes.

In: what is wished on a page, in MuJoCo's numbers. Out: calls of `Simulation` and
`InnerModelManager`; what does not work out is said, and not raised.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Protocol

import mujoco
import numpy as np

from robocomp_dsl.hardware.mujoco import axes
from robocomp_dsl.hardware.rotations import angles
from robocomp_dsl.hardware.simulation_interface import (
    InnerModelManagerProxy,
    Pose3D,
    SimulationProxy,
)
from robocomp_dsl.hardware.view.stage import Floats
from robocomp_dsl.runtime.errors import DeclaredError, MiddlewareError


class Far(Protocol):
    """Holds a world that runs elsewhere. What does not work out is told by it, and not raised."""

    def run(self, on: bool) -> None:
        """Let its time pass, or stand still."""

    def reset(self) -> None:
        """Let it begin anew."""

    def step(self, seconds: float) -> None:
        """Let so much time pass, and then stand still."""

    def speed(self) -> float:
        """Simulated seconds per second that are wished; 0: as many as possible."""

    def set_speed(self, speed: float) -> None:
        """Wish for others."""

    def move(self, joint: str, value: float, turns: bool) -> None:
        """A joint goes to a position in rad, or m where it does not turn."""

    def place(self, body: str, position: Floats, quat: Floats) -> None:
        """A body stands elsewhere in its parent: m, (w, x, y, z)."""


class FarHand:
    """Holds a simulation. `said` is what did not work out."""

    def __init__(self, hand: SimulationProxy, nodes: InnerModelManagerProxy | None) -> None:
        self._hand, self._nodes = hand, nodes
        self.said = ""

    def run(self, on: bool) -> None:
        """See `Far`."""
        self._try(self._hand.resume if on else self._hand.pause)

    def reset(self) -> None:
        """See `Far`."""
        self._try(self._hand.reset)

    def step(self, seconds: float) -> None:
        """See `Far`: whole steps of the physics, at least one."""
        self._try(lambda: self._step(seconds))

    def _step(self, seconds: float) -> None:
        self._hand.pause()
        before = self._hand.getState().time
        passed = self._hand.step(1) - before
        rest = round(seconds / passed) - 1 if passed > 0 else 0
        if rest > 0:
            self._hand.step(rest)

    def speed(self) -> float:
        """See `Far`."""
        try:
            return self._hand.getState().speed
        except MiddlewareError:
            return 1.0

    def set_speed(self, speed: float) -> None:
        """See `Far`."""
        self._try(partial(self._hand.setSpeed, speed))

    def move(self, joint: str, value: float, turns: bool) -> None:
        """See `Far`: its motor takes it there."""
        goal = np.array([value if turns else value / axes.MM])
        self._try(partial(self._hand.move, 0, [joint], goal))

    def place(self, body: str, position: Floats, quat: Floats) -> None:
        """See `Far`."""
        turned = np.zeros(9)
        mujoco.mju_quat2Mat(turned, quat)
        matrix = axes.matrix(position, turned)
        x, y, z = matrix[:3, 3].tolist()
        rx, ry, rz = angles(matrix[:3, :3])
        pose = Pose3D(x, y, z, rx, ry, rz)
        if self._nodes is None:
            self.said = "nodes cannot be placed from here"
            return
        # the root of MuJoCo has taken the name `world`
        self._try(partial(self._nodes.setPoseFromParent, body.removesuffix("."), pose))

    def _try(self, ask: Callable[[], Any]) -> None:
        try:
            ask()
        except (MiddlewareError, DeclaredError) as error:
            self.said = f"that did not work out: {_words(error)}"
        else:
            self.said = ""


def _words(error: Exception) -> str:
    """What a simulation declares has a text in one of two places."""
    return str(getattr(error, "what", "") or getattr(error, "text", "") or error)
