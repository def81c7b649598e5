"""The control law: joint torques from references, by mode and interaction of each joint.

In: references, measurements, direct commands. Out: wished torques (n,), before the limits. Which
terms a joint uses is worked out when its mode or its command changes, not at every step.
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

    Whoever changes one of them calls `apply`. `positioned` (n,) tells which joints hold a position
    now, `driven` which motors are on (1, else 0).
    """

    def __init__(self, pid: PidBank, impedance: Impedance, motors: Motors) -> None:
        n = len(pid.gains)
        self._pid, self._impedance, self._motors = pid, impedance, motors
        self.torque, self.duty, self.current = np.zeros(n), np.zeros(n), np.zeros(n)
        self.positioned: Bools = np.zeros(n, bool)
        self.driven = np.zeros(n)
        self._modes: tuple[Mode, ...] = (Mode.IDLE,) * n
        self._held, self._spring, self._direct = np.zeros(n), np.zeros(n), np.zeros(n)
        self._by_torque, self._by_duty, self._by_current = np.zeros(n), np.zeros(n), np.zeros(n)
        self._electric = False
        self._back_emf: Floats | None = None
        self._commanded = self._alone = False
        self._stiff = self._comply = self.all_driven = False

    def choose(self, modes: Sequence[Mode], interactions: Sequence[Interaction]) -> None:
        """Work out which terms each joint uses."""
        self._modes = tuple(modes)
        comply = np.array([one is Interaction.COMPLIANT for one in interactions])
        self.positioned = np.array([mode in POSITIONED for mode in modes])
        stiff, soft = self.positioned & ~comply, self.positioned & comply
        self._pid.use(stiff)
        self._stiff, self._comply = bool(stiff.any()), bool(soft.any())
        self._held, self._spring = self.positioned.astype(float), soft.astype(float)
        self._by_torque, self._by_duty = self._mask(Mode.TORQUE), self._mask(Mode.PWM)
        self._by_current = self._mask(Mode.CURRENT)
        self.driven = self._held + self._by_torque + self._by_duty + self._by_current
        self.all_driven = bool(self.driven.all())
        duty = self._by_duty.any()
        self._electric = bool(duty or self._by_current.any())
        self._back_emf = self._by_duty[:, None] * self._motors.back_emf if duty else None
        self.apply()

    def apply(self) -> None:
        """Work out the torques that torque, duty and current commands make at standstill."""
        self._direct = self._by_torque * self.torque
        if self._electric:
            self._direct += self._made_by_currents()
        self._commanded = bool(np.count_nonzero(self._direct))
        self._alone = not (self._commanded or self._comply or self._back_emf is not None)

    def step(
        self,
        error: Floats,
        velocity_error: Floats,
        velocity: Floats,
        feedforward: Floats | None,
        dt: float,
    ) -> Floats:
        """Wished torques, as if regulators had no bounds; where they pass one, `bounded` is due.

        `feedforward` (n,) is added where a position is held: weight, mostly.
        """
        held = self._pid.propose(error, velocity_error, dt) if self._stiff else None
        if held is not None and feedforward is None and self._alone:
            return held
        return self._sum(held, error, velocity_error, velocity, feedforward)

    def bounded(
        self, error: Floats, velocity_error: Floats, velocity: Floats, feedforward: Floats | None
    ) -> Floats:
        """The torques that `step` gave last, with the bounds of all regulators."""
        held = self._pid.bounded() if self._stiff else None
        return self._sum(held, error, velocity_error, velocity, feedforward)

    def _sum(
        self,
        held: Floats | None,
        error: Floats,
        velocity_error: Floats,
        velocity: Floats,
        feedforward: Floats | None,
    ) -> Floats:
        wished = self._direct
        if held is not None:
            wished = held + wished if self._commanded else held
        if self._comply:
            wished = wished + self._spring * self._impedance.torque(error, velocity_error)
        if feedforward is not None:
            wished = wished + self._held * feedforward
        if self._back_emf is not None:
            wished = wished - self._back_emf @ velocity
        return wished

    def _made_by_currents(self) -> Floats:
        duty, current, motors = self._by_duty, self._by_current, self._motors
        made = duty * motors.torque_of_current(motors.stall_current(self.duty * duty))
        made += current * motors.torque_of_current(self.current * current)
        return made

    def _mask(self, mode: Mode) -> Floats:
        return np.array([float(one is mode) for one in self._modes])
