"""Reference velocities of n joints: an acceleration-limited ramp towards what was commanded."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats, Ints


class VelocityRamp:
    """`target` is what was commanded, `velocity` where the ramp is, both (n,) [rad/s].

    A target may hold for a limited time (`until` seconds from now), as velocity commands of a
    caller that may die do.
    """

    def __init__(self, size: int) -> None:
        self.target = np.zeros(size)
        self.velocity = np.zeros(size)
        self._left = np.full(size, np.inf)
        self.active = False

    def command(self, joints: Ints, target: Floats, hold: float = np.inf) -> None:
        """Aim for `target`, for `hold` seconds."""
        self.target[joints] = target
        self._left[joints] = hold
        self.active = True

    def halt(self, joints: Ints) -> None:
        """At rest at once."""
        self.target[joints] = 0.0
        self.velocity[joints] = 0.0
        self._left[joints] = np.inf

    def step(self, acceleration: Floats, dt: float) -> Floats:
        """Let `dt` seconds pass; the velocities (n,)."""
        if not self.active:
            return self.velocity
        self._left -= dt
        over = self._left < 0.0
        if np.count_nonzero(over):
            self.target[over] = 0.0
            self._left[over] = np.inf
        reach = acceleration * dt
        change = np.minimum(self.target - self.velocity, reach)
        self.velocity += np.maximum(change, -reach, out=change)
        self.active = bool(np.count_nonzero(self.velocity) or np.count_nonzero(self.target))
        return self.velocity
