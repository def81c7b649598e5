"""Reference velocities of n joints: an acceleration-limited ramp to the commanded velocity."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats, Ints


class VelocityRamp:
    """`target` is the command, `velocity` the state of the ramp, both (n,) [rad/s].

    A target may expire, in case the caller exits. `active` is True while a joint moves or is
    about to.
    """

    def __init__(self, size: int) -> None:
        self.target = np.zeros(size)
        self.velocity = np.zeros(size)
        self.active = False
        self._steady = True
        self._clock = 0.0
        self._until = np.full(size, np.inf)
        self._next_end = np.inf

    def command(self, joints: Ints, target: Floats, hold: float = np.inf) -> None:
        """Ramp to `target`, for `hold` seconds."""
        self.target[joints] = target
        self._until[joints] = self._clock + hold
        self._next_end = float(self._until.min())
        self.active, self._steady = True, False

    def jump(self, joints: Ints, velocity: Floats) -> None:
        """Set `velocity` without a ramp."""
        self.command(joints, velocity)
        self.velocity[joints] = velocity

    def halt(self, joints: Ints) -> None:
        """Stop without a ramp."""
        self.target[joints] = 0.0
        self.velocity[joints] = 0.0
        self._until[joints] = np.inf
        self._next_end = float(self._until.min())
        self._steady = False

    def step(self, acceleration: Floats, dt: float) -> Floats:
        """Advance by `dt` seconds; returns the velocities (n,)."""
        if not self.active:
            return self.velocity
        self._clock += dt
        if self._clock > self._next_end:
            self._expire()
        if self._steady:
            return self.velocity
        reach = acceleration * dt
        change = np.minimum(self.target - self.velocity, reach)
        np.maximum(change, -reach, out=change)
        self.velocity += change
        self._steady = not np.count_nonzero(change)
        if self._steady:
            self.active = bool(np.count_nonzero(self.velocity))
        return self.velocity

    def _expire(self) -> None:
        """Set expired targets to 0."""
        over = self._until < self._clock
        self.target[over] = 0.0
        self._until[over] = np.inf
        self._next_end = float(self._until.min())
        self._steady = False
