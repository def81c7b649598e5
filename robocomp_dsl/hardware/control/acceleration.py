"""Smoothed accelerations of n joints, from measured speeds.

In: speeds, at every step. Out: accelerations.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats

SMOOTHING = 0.02
"""Time constant [s]."""


class AccelerationFilter:
    """A first-order high-pass filter: the speed minus its low-pass filtered value, over time."""

    def __init__(self, velocity: Floats) -> None:
        self._dt = 0.0
        self._share = np.zeros(len(velocity))
        self.begin(velocity)

    def begin(self, velocity: Floats) -> None:
        """Start from a constant speed."""
        self._slow = velocity.copy()

    def add(self, velocity: Floats, dt: float) -> None:
        """Add the speeds (n,) after another `dt` seconds."""
        if dt != self._dt:
            self._dt = dt
            self._share[:] = dt / (dt + SMOOTHING)  # numpy is slower with a scalar
        change = velocity - self._slow
        change *= self._share
        self._slow += change

    def now(self, velocity: Floats) -> Floats:
        """Accelerations (n,); `velocity` (n,) are the latest speeds."""
        now: Floats = (velocity - self._slow) / SMOOTHING
        return now
