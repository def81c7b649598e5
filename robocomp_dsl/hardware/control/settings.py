"""Settings of a control board, per joint: speeds, impedance, PIDs, limits, encoders.

In: joints by name or number, values in SI units. Settings cause no motion; an invalid value is
rejected with a typed error and changes nothing.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Joints, Values
from robocomp_dsl.hardware.control.joints import Bools, Floats, numbers
from robocomp_dsl.hardware.control.protection.faults import FaultReport
from robocomp_dsl.hardware.control.regulators.loops import Loop
from robocomp_dsl.hardware.control.regulators.pid import Gains


class ControlSettings:
    """The settings of a board."""

    def __init__(self, board: Board) -> None:
        self._board = board

    def set_reference_speed(self, joints: Joints, speed: Values) -> None:
        """Mean speeds [rad/s] of later position motions; clipped to the speed limit."""
        chosen = self._board.select.indices(joints)
        values = np.abs(numbers("speed", speed, len(chosen)))
        most = self._board.limits.speed[chosen]
        self._board.references.reference_speed[chosen] = np.minimum(values, most)

    def reference_speed(self, joints: Joints = None) -> Floats:
        """Mean speeds [rad/s] of position motions."""
        return self._board.references.reference_speed[self._board.select.indices(joints)]

    def acceleration(self, joints: Joints = None) -> Floats:
        """Acceleration limits [rad/s²] of velocity commands."""
        return self._board.references.acceleration[self._board.select.indices(joints)]

    def set_acceleration(self, joints: Joints, acceleration: Values) -> None:
        """Acceleration limits [rad/s²] in the velocity and mixed modes."""
        chosen = self._board.select.indices(joints)
        values = np.abs(numbers("acceleration", acceleration, len(chosen)))
        self._board.references.acceleration[chosen] = values

    def set_impedance(self, joints: Joints, stiffness: Values, damping: Values) -> None:
        """Stiffness [N m/rad] and damping [N m s/rad] of the compliant interaction."""
        chosen = self._board.select.indices(joints)
        k = numbers("stiffness", stiffness, len(chosen))
        self._board.impedance.set(chosen, k, numbers("damping", damping, len(chosen)))

    def set_impedance_offset(self, joints: Joints, torque: Values) -> None:
        """Constant torque [N m] of the compliant interaction."""
        chosen = self._board.select.indices(joints)
        self._board.impedance.offset[chosen] = numbers("torque", torque, len(chosen))

    def set_pid(self, joint: str | int, gains: Gains, loop: Loop = Loop.POSITION) -> None:
        """The PID gains of one joint."""
        self._board.loops.set(loop, self._board.select.index(joint), gains)
        self._board.law.regulate()

    def pid(self, joint: str | int, loop: Loop = Loop.POSITION) -> Gains:
        """The PID gains of one joint."""
        return self._board.loops.gains[loop][self._board.select.index(joint)]

    def enable_pid(self, joints: Joints, on: bool, loop: Loop = Loop.POSITION) -> None:
        """Enable or disable controllers; a disabled one outputs 0."""
        self._board.loops.enable(loop, self._board.select.indices(joints), on=on)
        self._board.law.regulate()

    def pid_enabled(self, joints: Joints = None, loop: Loop = Loop.POSITION) -> Bools:
        """Which controllers are enabled."""
        return self._board.loops.enabled[loop][self._board.select.indices(joints)]

    def reset_pid(self, joints: Joints = None, loop: Loop = Loop.POSITION) -> None:
        """Reset the integrals of the controllers."""
        chosen = self._board.select.indices(joints)
        if loop is Loop.CURRENT:
            self._board.law.currents.reset(chosen)
        else:
            self._board.loops.reset(loop, chosen)

    def pid_reference(self, joints: Joints = None, loop: Loop = Loop.POSITION) -> Floats:
        """References of the controllers of this loop, active or not."""
        board, chosen = self._board, self._board.select.indices(joints)
        found = {
            Loop.POSITION: board.references.position,
            Loop.VELOCITY: board.references.velocity,
            Loop.TORQUE: board.law.torque,
            Loop.CURRENT: board.law.current,
        }
        return found[loop][chosen]

    def pid_error(self, joints: Joints = None, loop: Loop = Loop.POSITION) -> Floats:
        """Errors of the controllers."""
        board, chosen = self._board, self._board.select.indices(joints)
        looks = board.law.errors
        found = {
            Loop.POSITION: board.position,
            Loop.VELOCITY: board.velocity,
            Loop.TORQUE: looks.measured_torque if looks.needs_torque else board.torque,
            Loop.CURRENT: board.current,
        }
        return self.pid_reference(joints, loop) - found[loop][chosen]

    def pid_output(self, joints: Joints = None, loop: Loop = Loop.POSITION) -> Floats:
        """Outputs of the controllers; 0 if this loop is inactive."""
        board, chosen = self._board, self._board.select.indices(joints)
        output = board.law.currents.output if loop is Loop.CURRENT else board.pid.output
        return np.where(board.loops.works(loop), output, 0.0)[chosen]

    def impedance(self, joint: str | int) -> tuple[float, float, float]:
        """Stiffness [N m/rad], damping [N m s/rad] and offset [N m] of one joint."""
        at, spring = self._board.select.index(joint), self._board.impedance
        return float(spring.stiffness[at]), float(spring.damping[at]), float(spring.offset[at])

    def set_max_current(self, motors: Joints, current: Values) -> None:
        """The currents [A] at which motors fault."""
        chosen = self._board.select.indices(motors)
        self._board.motors.set_max_current(chosen, numbers("current", current, len(chosen)))

    def set_position_limits(self, joints: Joints, low: Values, high: Values) -> None:
        """Narrow the ranges [rad]; wider ranges than the joint's own are rejected."""
        chosen = self._board.select.indices(joints)
        lowest = numbers("low", low, len(chosen))
        self._board.limits.set_position(chosen, lowest, numbers("high", high, len(chosen)))

    def position_limits(self, joints: Joints = None) -> tuple[Floats, Floats]:
        """Lower and upper limits [rad]."""
        chosen = self._board.select.indices(joints)
        return self._board.limits.low[chosen], self._board.limits.high[chosen]

    def set_speed_limits(self, joints: Joints, speed: Values) -> None:
        """Maximum speeds [rad/s]."""
        chosen = self._board.select.indices(joints)
        self._board.limits.set_speed(chosen, numbers("speed", speed, len(chosen)))

    def set_encoder(self, joints: Joints, position: Values) -> None:
        """Set the encoder readings to `position` [rad] without motion."""
        chosen = self._board.select.indices(joints)
        self._board.set_encoders(chosen, numbers("position", position, len(chosen)))

    def set_motor_encoder(self, motors: Joints, counts: Values) -> None:
        """Set the motors' encoder counts."""
        chosen = self._board.select.indices(motors)
        values = numbers("counts", counts, len(chosen))
        self._board.motors.set_encoder(chosen, values, self._board.position)

    def set_reference_timeout(self, seconds: float) -> None:
        """Time-out of streamed torques, duty cycles and currents [s]; 0: none."""
        self._board.watchdog.set_timeout(seconds)

    def last_fault(self, joint: str | int) -> FaultReport:
        """The last fault of a joint; it stays available after the fault is cleared."""
        return self._board.faults.last[self._board.select.index(joint)]
