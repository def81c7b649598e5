"""Motors with gears and couplings, their amplifiers, and the encoders on both ends.

In: joint angles and torques. Out: motor angles, encoder counts, currents, duty cycles. With M =
diag(gear) @ coupling, motor angles are M @ joint angles and joint torques M^T @ motor torques.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import BoardSpec, Floats, Ints

ROOM_TEMPERATURE = 25.0


class Motors:
    """All arrays (n,), by motor.

    `overloadable`: a motor can reach its maximum current; `hot`: a motor is too hot.
    """

    def __init__(self, spec: BoardSpec) -> None:
        self.gear = spec.motor_column("gear")
        self.counts = spec.motor_column("counts")
        self.torque_constant = spec.motor_column("torque_constant")
        self.resistance = spec.motor_column("resistance")
        self.supply = spec.motor_column("supply")
        self.max_current = spec.motor_column("max_current")
        self.temperature_limit = spec.motor_column("temperature_limit")
        self.temperature = np.full(len(self.gear), ROOM_TEMPERATURE)
        self.hot = False
        self.zero = np.zeros(len(self.gear))  # counts at motor angle 0, set by the user
        self.to_motor = self.gear[:, None] * spec.coupling
        self._torque_to_motor = np.linalg.inv(self.to_motor).T
        # joint torque per motor current, and the joint damping by the back EMF
        self._per_amp = self.to_motor.T * self.torque_constant
        bemf = self.torque_constant**2 / self.resistance
        self.back_emf = self.to_motor.T @ (bemf[:, None] * self.to_motor)
        self._to_counts = (self.counts / (2 * np.pi))[:, None] * self.to_motor
        self._to_current = self._torque_to_motor / self.torque_constant[:, None]
        share = 100.0 / self.supply
        self._duty_of_torque = (share * self.resistance)[:, None] * self._to_current
        self._duty_of_speed = (share * self.torque_constant)[:, None] * self.to_motor
        most = np.abs(self._torque_to_motor) @ spec.column("torque_limit")
        self._most_current = most / self.torque_constant
        self.overloadable = self._may_overload()

    def current(self, torque: Floats) -> Floats:
        """Motor currents [A] for joint torques (n,) [N m]."""
        current: Floats = self._to_current.dot(torque)
        return current

    def torque_of_current(self, current: Floats) -> Floats:
        """Joint torques of motor currents."""
        torque: Floats = self._per_amp @ current
        return torque

    def stall_current(self, duty: Floats) -> Floats:
        """Currents [A] of duty cycles [%] at standstill; `back_emf` is the effect of motion."""
        current: Floats = self.supply * duty / (100.0 * self.resistance)
        return current

    def torque_of_duty(self, duty: Floats, joint_velocity: Floats) -> Floats:
        """Joint torques of duty cycles [%] at the joints' velocities."""
        stalled = self.torque_of_current(self.stall_current(duty))
        torque: Floats = stalled - self.back_emf @ joint_velocity
        return torque

    def duty(self, torque: Floats, joint_velocity: Floats) -> Floats:
        """Duty cycles [%] that produce joint torques at the joints' velocities, within +-100."""
        duty: Floats = self._duty_of_torque.dot(torque) + self._duty_of_speed.dot(joint_velocity)
        return np.minimum(np.maximum(duty, -100.0), 100.0)

    def duty_of_speed(self, joint_velocity: Floats) -> Floats:
        """Duty cycles [%] equivalent to the back EMF, beyond +-100 for fast motors."""
        duty: Floats = self._duty_of_speed @ joint_velocity
        return duty

    def encoder(self, joint_angles: Floats) -> Floats:
        """Encoder counts of the motors, whole numbers."""
        return np.asarray(np.floor(self._to_counts.dot(joint_angles)) + self.zero)

    def set_encoder(self, motors: Ints, counts: Floats, joint_angles: Floats) -> None:
        """Set the encoder counts of `motors`."""
        self.zero[motors] += counts - self.encoder(joint_angles)[motors]

    def speed(self, joint_velocities: Floats) -> Floats:
        """Encoder counts per second."""
        return np.asarray(self._to_counts.dot(joint_velocities))

    def set_temperature(self, temperature: Floats) -> None:
        """Set the measured temperatures (n,) [degC]."""
        self.temperature = temperature
        self.hot = bool((temperature > self.temperature_limit).any())

    def set_max_current(self, motors: Ints, current: Floats) -> None:
        """The current [A] at which a motor faults."""
        if (current < 0.0).any():
            raise BadValue("a largest current must not be negative")
        self.max_current[motors] = current
        self.overloadable = self._may_overload()

    def _may_overload(self) -> bool:
        """Whether torques within the joints' limits can exceed a motor's maximum current."""
        return bool((self._most_current >= self.max_current).any())
