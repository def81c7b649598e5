"""Where n joints shall be now: trajectories, velocities and direct positions together.

In: commands of the position, direct, velocity and mixed modes. Out: reference positions and
velocities (n,), always within the limits.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import BoardSpec, Floats, Ints
from robocomp_dsl.hardware.control.limits import Limits
from robocomp_dsl.hardware.control.minimum_jerk import PEAK, MinimumJerk
from robocomp_dsl.hardware.control.velocity import VelocityRamp

LEAD = 0.1
"""How far a reference that moves by velocity may run ahead of its joint [rad]."""

STREAM_GAP = 0.1
"""Direct positions further apart in time than this are steps, not a motion [s]."""


class References:
    """`position` and `velocity` (n,) are what the regulators follow after `step`."""

    def __init__(self, spec: BoardSpec, limits: Limits) -> None:
        n = len(spec.joints)
        self._limits = limits
        self.trajectory = MinimumJerk(np.zeros(n))
        self.ramp = VelocityRamp(n)
        self.reference_speed = spec.column("reference_speed")
        self.acceleration = spec.column("acceleration")
        self.position = np.zeros(n)
        self.velocity = np.zeros(n)
        self._stream = np.zeros(n)  # speed of a stream of direct positions
        self._age = np.full(n, np.inf)  # time since the last one
        self._streaming = False

    def move(self, joints: Ints, goal: Floats, dt: float) -> None:
        """Minimum jerk to `goal` at the reference speeds, slower where the peak is too fast."""
        speed = np.minimum(self.reference_speed[joints], self._limits.speed[joints] / PEAK)
        self.trajectory.move(joints, goal, speed, dt)

    def direct(self, joints: Ints, position: Floats) -> None:
        """Follow `position` at once; a steady stream also tells how fast it goes."""
        age = np.maximum(self._age[joints], 1e-6)
        speed = (position - self.trajectory.position[joints]) / age
        most = self._limits.speed[joints]
        known = np.where(age < STREAM_GAP, np.clip(speed, -most, most), 0.0)
        self.trajectory.halt(joints, position)
        self._stream[joints] = known
        self._age[joints] = 0.0
        self._streaming = True

    def drive(self, joints: Ints, velocity: Floats, hold: float) -> None:
        """Reference velocities, reached by the joints' acceleration, for `hold` seconds."""
        self.ramp.command(joints, velocity, hold)

    def stop(self, joints: Ints) -> None:
        """End every motion of `joints` where the reference is now; velocities ramp down."""
        self.trajectory.halt(joints, self.trajectory.position[joints])
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

    def step(self, measured: Floats, dt: float) -> None:
        """Let `dt` seconds pass; `measured` (n,) keeps a blocked joint's reference near it."""
        self.trajectory.step(dt)
        low, high = self._limits.low, self._limits.high
        velocity = self.trajectory.velocity
        if self.ramp.active:
            driven = self.ramp.step(self.acceleration, dt)
            moving = driven != 0.0
            room = np.where(driven > 0.0, measured + LEAD, measured - LEAD)
            ahead = (self.trajectory.position - room) * np.sign(driven) > 0.0
            self.trajectory.shift(np.where(moving & ~ahead, driven * dt, 0.0), low, high)
            velocity = velocity + driven
        if self._streaming:
            velocity = velocity + self._streamed(dt)
        self.position = np.minimum(np.maximum(self.trajectory.position, low), high)
        at_end = (self.position >= high) & (velocity > 0.0)
        at_end |= (self.position <= low) & (velocity < 0.0)
        self.velocity = np.where(at_end, 0.0, velocity)

    def _streamed(self, dt: float) -> Floats:
        self._age += dt
        self._streaming = bool((self._age < STREAM_GAP).any())
        fresh: Floats = np.where(self._age < STREAM_GAP, self._stream, 0.0)
        return fresh
