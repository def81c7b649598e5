"""A control board: from the sensors of n joints to the torques of their motors.

In, at every step: joint angles and speeds (n,), the time since the last step. Out: torques (n,)
within all limits. `Commands` sets references; `Calibrator` and `Parking` override motions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from robocomp_dsl.hardware.control.acceleration import AccelerationFilter
from robocomp_dsl.hardware.control.joints import BoardSpec, Floats, Ints, Selector
from robocomp_dsl.hardware.control.mode_table import ModeTable
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.motors import Motors
from robocomp_dsl.hardware.control.protection.bounds_check import BoundsCheck
from robocomp_dsl.hardware.control.protection.faults import FaultCode, Faults, overloaded, too_hot
from robocomp_dsl.hardware.control.protection.limits import JointLimits
from robocomp_dsl.hardware.control.protection.watchdog import Watchdog
from robocomp_dsl.hardware.control.regulators.impedance import Bounds, Impedance
from robocomp_dsl.hardware.control.regulators.law import ControlLaw
from robocomp_dsl.hardware.control.regulators.loops import ControlLoops
from robocomp_dsl.hardware.control.state import BoardState
from robocomp_dsl.hardware.control.trajectories.references import References


class Board:
    """The parts of a board and its last measurements. Not thread-safe."""

    def __init__(self, spec: BoardSpec) -> None:
        n = len(spec.joints)
        self.spec, self.select = spec, Selector(spec.names)
        self.limits, self.motors, self.faults = JointLimits(spec), Motors(spec), Faults(n)
        self.loops = ControlLoops(spec)
        self.pid = self.loops.bank
        bounds = tuple(Bounds(20 * j.torque_limit, 2 * j.torque_limit) for j in spec.joints)
        self.impedance = Impedance(bounds)
        self.references = References(spec, self.limits)
        self.law = ControlLaw(self.loops, self.impedance, self.motors)
        self.bounds_check = BoundsCheck(self.limits, self.pid)
        self.table, self.watchdog = ModeTable(spec), Watchdog(spec)
        self.motion_overrides: list[Callable[[float], None]] = []
        self.time, self.dt = 0.0, 0.001
        self.offset = np.zeros(n)
        self.position, self.velocity = np.zeros(n), np.zeros(n)
        self._acceleration = AccelerationFilter(self.velocity)
        self.torque = np.zeros(n)
        self._started = self._shifted = False
        self.refresh()

    @property
    def acceleration(self) -> Floats:
        """Accelerations (n,) of the joints [rad/s²], smoothed."""
        return self._acceleration.now(self.velocity)

    @property
    def current(self) -> Floats:
        """Currents (n,) of the motors [A]."""
        return self.motors.current(self.torque)

    def begin(self, position: Floats, velocity: Floats) -> None:
        """Initialise from the first measurement: everything is at rest, before any command."""
        self._started = True
        self.position = position + self.offset
        self.velocity = velocity
        self._acceleration.begin(velocity)
        self.references.reset(np.arange(len(position)), self.position)

    def step(
        self, position: Floats, velocity: Floats, dt: float, feedforward: Floats | None = None
    ) -> Floats:
        """Torques (n,) [N m] for the next `dt` seconds; inputs (n,) must not be modified later.

        `feedforward` are gravity torques; they are used while a position is held.
        """
        self.time += dt
        self.dt = dt
        self._sense(position, velocity, dt)
        if self.time >= self.watchdog.due:
            self._hold_expired(self.watchdog.expired(self.time))
        for lead in self.motion_overrides:
            lead(dt)
        self.references.step(self.position, dt)
        error = self.references.position - self.position
        late = self.references.velocity - self.velocity
        torque = self.law.step(error, late, self.velocity, feedforward, dt)
        if not self.bounds_check.within_bounds(self.position, self.velocity, torque):
            torque = self.law.bounded(error, late, self.velocity, feedforward)
            torque = self.limits.guard(self.position, self.velocity, torque)
        self.torque = torque if self.law.all_powered else torque * self.law.powered
        if self.motors.overloadable or self.motors.hot or self.pid.tracks:
            self._detect_faults(error)
        return self.torque

    def set_modes(self, joints: Ints, modes: Sequence[Mode]) -> None:
        """Change control modes; raises `ModeRefused` and then changes none."""
        changed = self.table.request(joints, modes)
        self.faults.clear(self.table.coupled(joints))
        if len(changed):
            self._reset_joints(changed)

    def set_interactions(self, joints: Ints, modes: Sequence[Interaction]) -> None:
        """Change interaction modes; raises `NotEquipped` or `ModeRefused`."""
        self.table.request_interaction(joints, modes)
        self.refresh()

    def force_mode(self, joint: int, mode: Mode, acting: Mode | None = None) -> None:
        """Force a joint into `mode`; its motor is driven as in the mode `acting`."""
        self.table.force(joint, mode, acting)
        self._reset_joints(np.array([joint]))

    def fault(self, joints: Ints, code: FaultCode, message: str) -> None:
        """Switch `joints`, and those coupled with them, off until force-idle."""
        self.faults.raise_(joints, code, message)
        whole = self.table.coupled(joints)
        for joint in whole.tolist():
            self.table.force(joint, Mode.HW_FAULT)
        self._reset_joints(whole)
        self.torque = self.torque * self.law.powered

    def set_streamed_reference(self, kind: Floats, joints: Ints, values: Floats) -> None:
        """References of `kind`: the torques, duty cycles or currents of the control law."""
        kind[joints] = values
        self.law.apply()
        self.watchdog.feed(joints, self.time)

    def set_encoders(self, joints: Ints, position: Floats) -> None:
        """Set the encoders of `joints` to `position`; references move along."""
        self.offset[joints] += position - self.position[joints]
        self._shifted = True
        self.position = self.position.copy()
        self.position[joints] = position
        self.references.reset(joints, position)

    def check_torque(self, felt: Floats) -> Floats:
        """Torque readings (n,); NaN becomes 0 and a fault."""
        good = np.isfinite(felt)
        if not good.all():
            self._trip(np.flatnonzero(~good), FaultCode.SENSOR, "the torque sensor reads NaN")
        return np.where(good, felt, 0.0)

    def refresh(self) -> None:
        """Update values that depend on modes and calibration."""
        self.limits.trust(self.table.calibrated)
        self.law.configure(self.table.effective, self.table.interactions)

    def state(self) -> BoardState:
        """A copy of the latest measurements."""
        return BoardState(
            time=self.time,
            position=self.position.copy(),
            velocity=self.velocity.copy(),
            acceleration=self.acceleration,
            torque=self.torque.copy(),
            reference=self.references.position.copy(),
            motor_counts=self.motors.encoder(self.position),
            motor_speed=self.motors.speed(self.velocity),
            current=self.current,
            duty=self.motors.duty(self.torque, self.velocity) * self.law.powered,
            temperature=self.motors.temperature.copy(),
            modes=tuple(self.table.modes),
            interactions=self.table.interactions,
            faults=self.faults.now.copy(),
        )

    def _reset_joints(self, joints: Ints) -> None:
        """Initialise a new mode from the measurements, without jumps or old integrals."""
        self.references.reset(joints, self.position[joints])
        self.pid.reset(joints)
        self.law.currents.reset(joints)
        idle = [self.table.modes[i] is Mode.IDLE for i in joints.tolist()]
        self.law.torque[joints] = np.where(idle, 0.0, self.torque[joints])
        self.law.duty[joints] = 0.0
        self.law.current[joints] = 0.0
        self.watchdog.follow(joints, [self.table.modes[i] for i in joints.tolist()], self.time)
        self.refresh()

    def _hold_expired(self, joints: Ints) -> None:
        """References of `joints` timed out: hold their positions with compliance."""
        message = f"no reference came for {self.watchdog.timeout:g} s: it holds its position"
        self.faults.raise_(joints, FaultCode.REFERENCE_TIMEOUT, message)
        for joint in joints.tolist():
            self.table.make_compliant(joint)
        self._reset_joints(joints)

    def _sense(self, position: Floats, velocity: Floats, dt: float) -> None:
        if not math.isfinite(float(position.dot(velocity))):
            position, velocity = self._replace_invalid(position, velocity)
        self.position = position + self.offset if self._shifted else position
        if not self._started:
            self.begin(position, velocity)
        self._acceleration.add(velocity, dt)
        self.velocity = velocity

    def _replace_invalid(self, position: Floats, velocity: Floats) -> tuple[Floats, Floats]:
        """Fault joints whose encoders read NaN, and use their last angle."""
        good = np.isfinite(position) & np.isfinite(velocity)
        self._trip(np.flatnonzero(~good), FaultCode.ENCODER, "the encoder reads NaN")
        last = self.position - self.offset
        return np.where(good, position, last), np.where(good, velocity, 0.0)

    def _detect_faults(self, error: Floats) -> None:
        """Detect faults after a step."""
        if self.motors.overloadable:
            over = np.flatnonzero(overloaded(self.motors, self.current))
            self._trip(over, FaultCode.OVERCURRENT, "the motor current is too large")
        if self.motors.hot:
            hot = np.flatnonzero(too_hot(self.motors))
            self._trip(hot, FaultCode.OVERTEMPERATURE, "the motor is too hot")
        if self.pid.tracks:
            held = np.flatnonzero((np.abs(error) > self.pid.error_limit) & self.law.positioned)
            self._trip(held, FaultCode.TRACKING, "the position error is too large")

    def _trip(self, joints: Ints, code: FaultCode, message: str) -> None:
        """Fault those of `joints` that have no fault yet."""
        fresh = [i for i in joints.tolist() if self.table.modes[i] is not Mode.HW_FAULT]
        if fresh:
            self.fault(np.array(fresh), code, message)
