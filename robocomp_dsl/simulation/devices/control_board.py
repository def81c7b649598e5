"""A control board on the joints of a simulated robot.

In: a compiled MuJoCo model whose joints have torque motors of the same name. Out: before every
physics step the board reads the joints and sets the motors. Encoders may start with an unknown
offset (`encoder_zero`), which calibration then finds.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.joints import run
from robocomp_dsl.hardware.control.motors import ROOM_TEMPERATURE
from robocomp_dsl.hardware.control.settings import ControlSettings
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.simulation.robots.boards import RobotBoard

Floats = NDArray[np.float64]

HEATING_RATE = 4.0
"""Heating of a motor [K/W]."""

COOLING_RATE = 120.0
"""Time constant of its temperature [s]."""

FEELING = 0.005
"""Time constant of the torque sensors [s]."""

HEAT_PERIOD = 0.1
"""Period of the temperature update [s]."""


class SimulatedBoard:
    """A part of a `World`: `board` has the state, `commands` and `settings` its operations.

    `groups` maps joints to separately served groups.
    """

    groups: Mapping[str, str] = MappingProxyType({})

    def __init__(
        self,
        robot_board: RobotBoard,
        *,
        prefix: str = "",
        hold_weight: bool = True,
        encoder_zero: Floats | None = None,
    ) -> None:
        n = len(robot_board.joints)
        self.board = Board(robot_board.spec)
        self.commands, self.settings = Commands(self.board), ControlSettings(self.board)
        self._joints = tuple(prefix + name for name in robot_board.joints)
        self._motors = self._joints
        self._hold_weight = hold_weight
        self._unheated = 0.0
        self._zero = encoder_zero
        self._plain = bool(np.array_equal(robot_board.transmission, np.eye(n)))
        self._to_joint = np.linalg.inv(robot_board.transmission)
        self._from_board = robot_board.transmission
        self._to_board = robot_board.transmission.T

    def build(self, spec: Any) -> None:
        """Nothing to add: the robot already has motors."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002 - shared
        """Find joints and motors; raises `SceneError` for missing ones."""
        self.find(model, data)
        self.board.begin(*self._measure())

    def find(self, model: Any, data: Any) -> None:
        """The same joints in another model."""
        self._data = data
        found = [
            self._find(model, *names) for names in zip(self._joints, self._motors, strict=True)
        ]
        self._where, self._speed, self._motor = (
            np.array(column) for column in zip(*found, strict=True)
        )
        self._runs = run(self._where), run(self._speed), run(self._motor)
        self._damping = model.dof_damping[self._speed].copy()
        self._armature = model.dof_armature[self._speed].copy()
        self._borne = bool(model.ngravcomp)
        self._look()

    def _look(self) -> None:
        """Cached views of the data: creating them at every step costs as much as reading them."""
        self._places, self._speeds = self._data.qpos, self._data.qvel
        self._ctrl = self._data.ctrl

    def __setstate__(self, state: dict[str, Any]) -> None:
        """A copy has views of the copied data."""
        self.__dict__.update(state)
        if "_data" in state:
            self._look()

    def before_step(self, dt: float) -> None:
        """Measure, step the board, and set the motors."""
        q, dq = self._measure()
        weight = self._weight() if self._hold_weight else None
        if self.board.law.errors.needs_torque:
            self._measure_torque(dt)
        torque = self.board.step(q, dq, dt, weight)
        self._ctrl[self._runs[2]] = torque if self._plain else self._to_joint.T @ torque
        self._unheated += dt
        if self._unheated >= HEAT_PERIOD:
            self._update_temperature()

    def _measure(self) -> tuple[Floats, Floats]:
        """Encoder angles, and speeds."""
        where, speed, _ = self._runs
        q, dq = self._places[where].copy(), self._speeds[speed].copy()
        if not self._plain:
            q, dq = self._to_joint @ q, self._to_joint @ dq
        return (q if self._zero is None else q + self._zero), dq

    def _measure_torque(self, dt: float) -> None:
        """Torque readings after the motors: their torques minus the inertia of their rotors."""
        motors, turning = self._data.qfrc_actuator[self._speed], self._data.qacc[self._speed]
        torque = motors - self._armature * turning - self._damping * self._speeds[self._speed]
        felt = self.board.law.errors.measured_torque
        measured = torque if self._plain else self._to_board @ torque
        self.board.law.errors.measured_torque = felt + (measured - felt) * (dt / (dt + FEELING))

    def _weight(self) -> Floats:
        """Torques that compensate gravity, Coriolis forces and joint friction."""
        reference = self.board.references.velocity
        _, speed, _ = self._runs
        bias = self._data.qfrc_bias[speed]
        if self._borne:  # weightless joints need no compensation
            bias = bias - self._data.qfrc_gravcomp[speed]
        if self._plain:
            held: Floats = bias + self._damping * reference
            return held
        drag = self._damping * (self._from_board @ reference)
        weight: Floats = self._to_board @ (bias + drag)
        return weight

    def _update_temperature(self) -> None:
        """Update motor temperatures from currents and cooling; slow, so only now and then."""
        motors, current = self.board.motors, self.board.current
        final = ROOM_TEMPERATURE + HEATING_RATE * motors.resistance * current * current
        warmer = (final - motors.temperature) * (self._unheated / COOLING_RATE)
        motors.set_temperature(motors.temperature + warmer)
        self._unheated = 0.0

    @staticmethod
    def _find(model: Any, name: str, motor_name: str) -> tuple[int, int, int]:
        joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        motor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_ACTUATOR, motor_name)
        if joint < 0 or motor < 0:
            what = "joint" if joint < 0 else "motor"
            raise SceneError(f"the world has no {what} `{name}` for the control board")
        return int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint]), motor
