"""The acceleration of n joints, smoothed, from the speeds that are measured.

In: speeds, at every step. Out: accelerations.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats

SMOOTHING = 0.02
"""Time constant [s]."""


class AccelerationFilter:
    """A first-order high-pass filter: the speed less a slow one that follows it, over time."""

    def __init__(self, velocity: Floats) -> None:
        self._dt = 0.0
        self._share = np.zeros(len(velocity))
        self.begin(velocity)

    def begin(self, velocity: Floats) -> None:
        """It has always been that fast."""
        self._slow = velocity.copy()

    def add(self, velocity: Floats, dt: float) -> None:
        """The speeds (n,) after `dt` seconds more."""
        if dt != self._dt:
            self._dt = dt
            self._share[:] = dt / (dt + SMOOTHING)  # numpy is slower by a number than by a row
        change = velocity - self._slow
        change *= self._share
        self._slow += change

    def now(self, velocity: Floats) -> Floats:
        """Accelerations (n,); `velocity` (n,) are the speeds that were added last."""
        now: Floats = (velocity - self._slow) / SMOOTHING
        return now
