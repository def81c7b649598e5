"""The acceleration of n joints, smoothed, from the speeds that are measured.

In: speeds, at every step. Out: accelerations, when somebody asks for them: it is seldom asked, and
many steps at once cost hardly more than one.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats

SMOOTHING = 0.02
"""Time constant [s]."""

_MANY = 32
"""So many speeds are kept until they are summed up, whoever asks meanwhile."""


class Acceleration:
    """A first-order high-pass filter: the speed less a slow one that follows it, over time."""

    def __init__(self, velocity: Floats) -> None:
        self._dt = 0.001
        self.begin(velocity)

    def begin(self, velocity: Floats) -> None:
        """It has always been that fast."""
        self._slow = self._latest = velocity
        self._kept: list[Floats] = []

    def add(self, velocity: Floats, dt: float) -> None:
        """The speeds (n,) after `dt` seconds more; they must not be changed afterwards."""
        if dt != self._dt or len(self._kept) == _MANY:
            self._slow, self._kept, self._dt = self._followed(), [], dt
        self._kept.append(velocity)
        self._latest = velocity

    def now(self) -> Floats:
        """Accelerations (n,)."""
        return (self._latest - self._followed()) / SMOOTHING

    def _followed(self) -> Floats:
        """The slow speed after all that was kept."""
        if not self._kept:
            return self._slow
        share = self._dt / (self._dt + SMOOTHING)
        left = (1.0 - share) ** np.arange(len(self._kept), -1, -1)
        followed: Floats = left[0] * self._slow + (share * left[1:]) @ np.array(self._kept)
        return followed
