"""The control law: joint torques from references, by mode and interaction of each joint.

In: references, measurements, direct commands. Out: requested torques (n,), before the limits. The
terms of a joint are selected when its mode or command changes, not in every step.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.modes import POSITIONED, Interaction, Mode
from robocomp_dsl.hardware.control.motors import Motors
from robocomp_dsl.hardware.control.regulators.control_errors import ControlErrors
from robocomp_dsl.hardware.control.regulators.currents import Currents
from robocomp_dsl.hardware.control.regulators.impedance import Impedance
from robocomp_dsl.hardware.control.regulators.loops import ControlLoops, Loop, loop_of


class ControlLaw:
    """`torque`, `duty` and `current` (n,) are the references of the modes of the same name.

    Call `apply` after a change of references, and `regulate` after a change of gains. `positioned`
    (n,) marks joints that hold a position, `driven` motors that are on (1, else 0).
    """

    def __init__(self, loops: ControlLoops, impedance: Impedance, motors: Motors) -> None:
        n = len(loops.active)
        self._loops, self._bank = loops, loops.bank
        self._impedance, self._motors = impedance, motors
        self.errors, self.currents = ControlErrors(n), Currents(motors)
        self.torque, self.duty, self.current = np.zeros(n), np.zeros(n), np.zeros(n)
        self.positioned: Bools = np.zeros(n, bool)
        self.powered = np.zeros(n)
        self._held, self._spring, self._direct = np.zeros(n), np.zeros(n), np.zeros(n)
        self._by_torque, self._by_duty = np.zeros(n), np.zeros(n)
        self._ahead: Floats | None = None
        self._back_emf: Floats | None = None
        self._commanded = self._alone = self._odd = False
        self._regulated = self._comply = self.all_powered = False

    def configure(self, modes: Sequence[Mode], interactions: Sequence[Interaction]) -> None:
        """Select the terms of each joint."""
        self._loops.use([loop_of(*pair) for pair in zip(modes, interactions, strict=True)])
        self.regulate()
        comply = np.array([pair is Interaction.COMPLIANT for pair in interactions])
        self.positioned = np.array([mode in POSITIONED for mode in modes])
        self._regulated = any(self._loops.active)
        self._held = self.positioned.astype(float)
        self._spring = (self.positioned & comply).astype(float)
        self._comply = bool(self._spring.any())
        self._by_torque, self._by_duty, by_current = (
            np.array([float(pair is mode) for pair in modes])
            for mode in (Mode.TORQUE, Mode.PWM, Mode.CURRENT)
        )
        self.powered = self._held + self._by_torque + self._by_duty + by_current
        self.all_powered = bool(self.powered.all())
        duty = self._by_duty.any()
        self._back_emf = self._by_duty[:, None] * self._motors.back_emf if duty else None
        self._direct = np.zeros(len(modes))
        self.apply()

    def regulate(self) -> None:
        """Update after a change of gains."""
        loops = self._loops
        self.errors.configure(loops)
        flows = loops.works(Loop.CURRENT)
        self.currents.configure(loops.gains[Loop.CURRENT], flows, loops.enabled[Loop.CURRENT])
        self.currents.feed(self.current)
        moving = loops.works(Loop.POSITION) | loops.works(Loop.VELOCITY)
        ahead = moving * (self._bank.feedforward > 0.0)
        self._ahead = ahead if ahead.any() else None
        self._odd = self.errors.beyond_position or self._ahead is not None

    def apply(self) -> None:
        """Set torque, duty and current commands."""
        self._bank.feed(self._by_torque * self.torque)
        if self.currents.active:
            self.currents.feed(self.current)
        if self._back_emf is not None:
            stalled = self._motors.stall_current(self._by_duty * self.duty)
            self._direct = self._motors.torque_of_current(stalled)
        self._commanded = bool(np.count_nonzero(self._direct))
        open_ = self._back_emf is not None
        self._alone = not (open_ or self._comply or self.currents.active)

    def step(
        self,
        error: Floats,
        velocity_error: Floats,
        velocity: Floats,
        feedforward: Floats | None,
        dt: float,
    ) -> Floats:
        """Torques without the bounds of the controllers; call `bounded` if one is exceeded.

        `feedforward` (n,), such as gravity torques, is added for joints that hold a position.
        """
        held = None
        if self._odd:
            held = self._propose(error, velocity_error, velocity, dt)
        elif self._regulated:
            held = self._bank.propose(error, velocity_error, dt)
        if held is not None and feedforward is None and self._alone:
            return held
        if self.currents.active:
            self.currents.step(velocity, dt)
        return self._sum(held, error, velocity_error, velocity, feedforward)

    def bounded(
        self, error: Floats, velocity_error: Floats, velocity: Floats, feedforward: Floats | None
    ) -> Floats:
        """The torques of the last `step`, with the bounds of all controllers applied."""
        held = self._bank.bounded() if self._regulated else None
        return self._sum(held, error, velocity_error, velocity, feedforward)

    def _propose(self, error: Floats, late: Floats, velocity: Floats, dt: float) -> Floats:
        """Outputs of the controllers if not all joints control position."""
        derivative = late
        ahead = None if self._ahead is None else self._ahead * (late + velocity)
        if self.errors.beyond_position:
            error, derivative = self.errors.compute(error, late, self.torque, dt)
        return self._bank.propose(error, derivative, dt, ahead)

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
        if self.currents.active:
            wished = wished + self.currents.torque
        if self._back_emf is not None:
            wished = wished - self._back_emf @ velocity
        return wished
