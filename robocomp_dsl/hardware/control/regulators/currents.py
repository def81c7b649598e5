"""Current controllers and the motors that they drive.

In: references [A], speeds of the joints [rad/s]. Out: joint torques. A current settles much faster
than one step of the board, so controller and motor are solved together over each step. With a motor
of resistance r and back EMF e, both in percent of its supply, and gains kp and ki,

    u = feedforward * reference + offset + kp * error + integral,    r * current = u - e

the error falls by exp(-ki / (r + kp) * time), for all gains and steps; kd is not used.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robocomp_dsl.hardware.control.joints import Bools, Floats, Ints
from robocomp_dsl.hardware.control.motors import Motors
from robocomp_dsl.hardware.control.regulators.pid import Gains


class Currents:
    """All arrays (n,) by motor: `output` and `integral` [%], `torque` [N m] by joint.

    `active` is True while any current is controlled.
    """

    def __init__(self, motors: Motors) -> None:
        n = len(motors.gear)
        self.active, self._motors = False, motors
        self.output, self.integral, self.torque = np.zeros(n), np.zeros(n), np.zeros(n)
        self._resistance = 100.0 * motors.resistance / motors.supply
        self._dt = 0.0

    def configure(self, gains: Sequence[Gains], here: Bools, enabled: Bools) -> None:
        """Control the currents in `here`; a controller that is not `enabled` outputs 0."""
        self.active, self._here = bool(here.any()), here.astype(float)
        works = here & enabled
        self._kp, self._ki, self._offset, self._forward, self._most, self._most_integral = (
            np.where(works, [getattr(gains_of_motor, name) for gains_of_motor in gains], 0.0)
            for name in ("kp", "ki", "offset", "feedforward", "max_output", "max_integral")
        )
        self._dt = 0.0  # no step response is cached
        flowing = np.diag(self._here / self._resistance)
        self._to_torque = np.array([self._motors.torque_of_current(row) for row in flowing]).T
        self.integral, self.output = self.integral * works, self.output * works

    def reset(self, joints: Ints) -> None:
        """Reset the integrals of `joints`."""
        self.integral[joints] = 0.0

    def feed(self, reference: Floats) -> None:
        """Set current references (n,)."""
        self._reference_given = self._forward * reference + self._offset
        self._voltage = self._resistance * reference - self._reference_given

    def step(self, velocity: Floats, dt: float) -> None:
        """Advance by `dt` seconds at the joints' `velocity` (n,)."""
        if dt != self._dt:
            self._prepare(dt)
        emf = self._motors.duty_of_speed(velocity)
        error = self._voltage - self.integral
        error += emf
        grown = self._growth * error
        grown += self.integral
        grown = np.minimum(np.maximum(grown, -self._most_integral), self._most_integral)
        requested = self._gain * error
        requested += grown
        requested += self._reference_given
        self.output = np.minimum(np.maximum(requested, -self._most), self._most)
        if np.count_nonzero(requested != self.output):
            # anti-windup: the integral stops while the output is saturated
            held = (requested != self.output) & (grown * error > 0.0)
            grown = np.where(held, self.integral, grown)
        self.integral = grown
        self.torque = self._to_torque @ (self.output - emf)

    def _prepare(self, dt: float) -> None:
        """Response to an error of 1 % over a step of `dt` seconds."""
        stiff = self._resistance + self._kp
        left = np.exp(-self._ki / stiff * dt)
        self._dt, self._growth, self._gain = dt, 1.0 - left, self._kp * left / stiff
