"""The control law: joint torques from references, by mode and interaction of each joint.

In: references, measurements, direct commands. Out: wished torques (n,), before the limits. Which
terms a joint uses is worked out when its mode changes, so that a step costs the same in any mode.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robocomp_dsl.hardware.control.impedance import Impedance
from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.modes import POSITIONED, Interaction, Mode
from robocomp_dsl.hardware.control.motors import Motors
from robocomp_dsl.hardware.control.pid import PidBank


class Law:
    """`torque`, `duty` and `current` (n,) are the references of the modes of the same name.

    `positioned` (n,) tells which joints hold a position now, `driven` which motors are on.
    """

    def __init__(self, pid: PidBank, impedance: Impedance, motors: Motors) -> None:
        n = len(pid.gains)
        self._pid, self._impedance, self._motors = pid, impedance, motors
        self.torque, self.duty, self.current = np.zeros(n), np.zeros(n), np.zeros(n)
        self._stiff, self._spring, self._torque = np.zeros(n), np.zeros(n), np.zeros(n)
        self._duty, self._current, self._held = np.zeros(n), np.zeros(n), np.zeros(n)
        self.positioned: Bools = np.zeros(n, bool)
        self.driven = np.zeros(n)  # 0 where the motor is off, else 1
        self._any = {"spring": False, "duty": False, "current": False}

    def choose(self, modes: Sequence[Mode], interactions: Sequence[Interaction]) -> None:
        """Work out which terms each joint uses."""
        self.positioned = np.array([mode in POSITIONED for mode in modes])
        comply = np.array([one is Interaction.COMPLIANT for one in interactions])
        self._held = self.positioned.astype(float)
        self._stiff = (self.positioned & ~comply).astype(float)
        self._spring = (self.positioned & comply).astype(float)
        self._torque = np.array([float(mode is Mode.TORQUE) for mode in modes])
        self._duty = np.array([float(mode is Mode.PWM) for mode in modes])
        self._current = np.array([float(mode is Mode.CURRENT) for mode in modes])
        self.driven = np.maximum(self._held, self._torque + self._duty + self._current)
        used = {"spring": self._spring, "duty": self._duty, "current": self._current}
        self._any = {name: bool(one.any()) for name, one in used.items()}

    def step(
        self,
        error: Floats,
        velocity_error: Floats,
        velocity: Floats,
        feedforward: Floats | None,
        dt: float,
    ) -> Floats:
        """Wished torques. `feedforward` (n,) is added where a position is held: weight, mostly."""
        wished = self._pid.step(error, velocity_error, dt, self._stiff)
        wished = wished + self._torque * self.torque
        if feedforward is not None:
            wished += self._held * feedforward
        if self._any["spring"]:
            wished += self._spring * self._impedance.torque(error, velocity_error)
        if self._any["duty"]:
            wished += self._duty * self._motors.torque_of_duty(self.duty * self._duty, velocity)
        if self._any["current"]:
            wished += self._current * self._motors.torque_of_current(self.current * self._current)
        return wished
