"""Controls a simulation in another process: its time, joints and nodes.

In: requests of a page, in MuJoCo's units. Out: calls of `Simulation` and `InnerModelManager`;
failures are reported, not raised.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Protocol

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.scene import ROOT
from robocomp_dsl.hardware.kinematics.rotations import angles
from robocomp_dsl.runtime.errors import DeclaredError, MiddlewareError
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.simulation_interface import (
    InnerModelManagerProxy,
    Pose3D,
    SimulationProxy,
)
from robocomp_dsl.simulation.view.stage import Floats


class SimulationControl(Protocol):
    """Controls a simulation in another process. Failures are not raised."""

    def run(self, on: bool) -> None:
        """Resume or pause its time."""

    def reset(self) -> None:
        """Reset it."""

    def step(self, seconds: float) -> None:
        """Advance by `seconds`, then pause."""

    def speed(self) -> float:
        """The requested speed in simulated seconds per second; 0: as fast as possible."""

    def set_speed(self, speed: float) -> None:
        """Set the requested speed."""

    def move(self, joint: str, value: float, turns: bool) -> None:
        """Move a joint to a position in rad, or m for a slide."""

    def place(self, body: str, above: str, position: Floats, quat: Floats) -> None:
        """Set the pose of a body in the body `above` (empty: the root): m, (w, x, y, z)."""


class RemoteSimulation:
    """Controls a simulation by its proxies. `error` describes the last failure."""

    def __init__(self, simulation: SimulationProxy, nodes: InnerModelManagerProxy | None) -> None:
        self._simulation, self._nodes = simulation, nodes
        self.error = ""

    def run(self, on: bool) -> None:
        """See `SimulationControl`."""
        self._try(self._simulation.resume if on else self._simulation.pause)

    def reset(self) -> None:
        """See `SimulationControl`."""
        self._try(self._simulation.reset)

    def step(self, seconds: float) -> None:
        """See `SimulationControl`: whole steps of the physics, at least one."""
        self._try(lambda: self._step(seconds))

    def _step(self, seconds: float) -> None:
        self._simulation.pause()
        before = self._simulation.getState().time
        passed = self._simulation.step(1) - before
        rest = round(seconds / passed) - 1 if passed > 0 else 0
        if rest > 0:
            self._simulation.step(rest)

    def speed(self) -> float:
        """See `SimulationControl`."""
        try:
            return self._simulation.getState().speed
        except MiddlewareError:
            return 1.0

    def set_speed(self, speed: float) -> None:
        """See `SimulationControl`."""
        self._try(partial(self._simulation.setSpeed, speed))

    def move(self, joint: str, value: float, turns: bool) -> None:
        """See `SimulationControl`: the joint's motor moves it."""
        goal = np.array([value if turns else value / axes.MM])
        self._try(partial(self._simulation.move, 0, [joint], goal))

    def place(self, body: str, above: str, position: Floats, quat: Floats) -> None:
        """See `SimulationControl`."""
        turned = np.zeros(9)
        mujoco.mju_quat2Mat(turned, quat)
        matrix = axes.matrix(position, turned)
        x, y, z = matrix[:3, 3].tolist()
        rx, ry, rz = angles(matrix[:3, :3])
        pose = Pose3D(x, y, z, rx, ry, rz)
        if self._nodes is None:
            self.error = "nodes cannot be placed from here"
            return
        # MuJoCo's root body uses the name `world`; falling bodies are in the root, not in their
        # parents of InnerModel
        item, base = body.removesuffix("."), above.removesuffix(".") or ROOT
        self._try(partial(self._nodes.setPose, base, item, pose))

    def _try(self, ask: Callable[[], Any]) -> None:
        try:
            ask()
        except (MiddlewareError, DeclaredError) as error:
            self.error = f"the command failed: {_error_text(error)}"
        else:
            self.error = ""


def _error_text(error: Exception) -> str:
    """The message of a declared exception is in `what` or `text`."""
    return str(getattr(error, "what", "") or getattr(error, "text", "") or error)
