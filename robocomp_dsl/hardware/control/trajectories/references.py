"""References of n joints: trajectories, velocities and direct positions.

In: commands of the position, direct, velocity and mixed modes. Out: reference positions and
velocities (n,), always within the limits.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import BoardSpec, Floats, Ints
from robocomp_dsl.hardware.control.protection.limits import JointLimits
from robocomp_dsl.hardware.control.trajectories.minimum_jerk import PEAK, MinimumJerk
from robocomp_dsl.hardware.control.trajectories.velocity import VelocityRamp

LEAD = 0.1
"""Maximum lead of a velocity-controlled reference over its joint [rad]."""

STREAM_GAP = 0.1
"""Direct positions with a longer interval are steps, without a velocity [s]."""


class References:
    """`position` and `velocity` (n,) are the references of the controllers after `step`."""

    def __init__(self, spec: BoardSpec, limits: JointLimits) -> None:
        n = len(spec.joints)
        self._limits = limits
        self.trajectory = MinimumJerk(np.zeros(n), (limits.low, limits.high))
        self.ramp = VelocityRamp(n)
        self.reference_speed = spec.column("reference_speed")
        self.acceleration = spec.column("acceleration")
        self.position = np.zeros(n)
        self.velocity = np.zeros(n)
        self._stream = np.zeros(n)  # speed of a stream of direct positions
        self._age = np.full(n, np.inf)  # time since the last position
        self._streaming = False
        self._changed = True

    def move(self, joints: Ints, goal: Floats, dt: float, speed: Floats | None = None) -> None:
        """Minimum jerk to `goal` at `speed` or the reference speeds; the limit bounds its peak."""
        wished = self.reference_speed[joints] if speed is None else speed
        most = self._limits.speed[joints]
        self.trajectory.move(joints, goal, np.minimum(wished, most / PEAK), dt, most)
        self._changed = True

    def set_position(self, joints: Ints, position: Floats) -> None:
        """Follow `position` without a trajectory; a regular stream also defines the velocity."""
        age = np.maximum(self._age[joints], 1e-6)
        speed = (position - self.trajectory.position[joints]) / age
        most = self._limits.speed[joints]
        known = np.where(age < STREAM_GAP, np.clip(speed, -most, most), 0.0)
        self.trajectory.halt(joints, position)
        self._stream[joints] = known
        self._age[joints] = 0.0
        self._streaming = True

    def set_velocity(self, joints: Ints, velocity: Floats, hold: float) -> None:
        """Velocity references with limited acceleration, for `hold` seconds."""
        self.ramp.command(joints, velocity, hold)

    def set_velocity_direct(self, joints: Ints, velocity: Floats) -> None:
        """Velocity references without a ramp."""
        self.ramp.jump(joints, velocity)

    def stop(self, joints: Ints) -> None:
        """Stop `joints`: trajectories end at the current reference, velocities ramp down."""
        self.trajectory.halt(joints, self.trajectory.position[joints])
        self._changed = True
        self._stream[joints] = 0.0
        if self.ramp.active:
            self.ramp.command(joints, np.zeros(len(joints)))

    def reset(self, joints: Ints, position: Floats) -> None:
        """At rest at `position`."""
        self.trajectory.halt(joints, position)
        self.ramp.halt(joints)
        self._stream[joints] = 0.0
        self._age[joints] = np.inf
        self.position[joints] = position
        self.velocity[joints] = 0.0
        self._changed = True

    def step(self, measured: Floats, dt: float) -> None:
        """Advance by `dt` seconds; the reference of a blocked joint stays near `measured` (n,)."""
        alone = not (self.ramp.active or self._streaming or self._changed)
        if alone and not self.trajectory.active:
            return
        self.trajectory.step(dt)
        if alone and self.trajectory.active:  # which is within the limits
            self.position, self.velocity = self.trajectory.position, self.trajectory.velocity
            return
        velocity = self.trajectory.velocity.copy()
        if self.ramp.active:
            velocity = velocity + self._driven(measured, dt)
        if self._streaming:
            velocity = velocity + self._streamed(dt)
        requested = self.trajectory.position
        self.position = np.minimum(requested, self._limits.high)
        np.maximum(self.position, self._limits.low, out=self.position)
        outside = self.position != requested
        if np.count_nonzero(outside):
            velocity = np.where(outside, 0.0, velocity)
        self.velocity = velocity
        # once more after the last motion, to copy its final values
        self._changed = self.ramp.active or self._streaming

    def _driven(self, measured: Floats, dt: float) -> Floats:
        """Shift trajectories by the ramp's velocities; returns the resulting velocities.

        The reference waits for a joint that lags behind it, or is at a limit.
        """
        driven = self.ramp.step(self.acceleration, dt)
        before = self.trajectory.position
        lead = (before - measured) * np.sign(driven)
        way = np.where(lead < LEAD, driven * dt, 0.0)
        self.trajectory.shift(way, self._limits.low, self._limits.high)
        carried = self.trajectory.position - before
        carried /= dt
        return carried

    def _streamed(self, dt: float) -> Floats:
        self._age += dt
        fresh = self._age < STREAM_GAP
        self._streaming = bool(np.count_nonzero(fresh))
        return np.where(fresh, self._stream, 0.0)
