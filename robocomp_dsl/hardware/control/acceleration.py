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
        self._kept = np.empty((_MANY, len(velocity)))
        self._weigh(0.001)
        self.begin(velocity)

    def begin(self, velocity: Floats) -> None:
        """It has always been that fast."""
        self._slow, self._count = velocity.copy(), 0

    def add(self, velocity: Floats, dt: float) -> None:
        """The speeds (n,) after `dt` seconds more."""
        if self._count == _MANY or dt != self._dt:
            self._slow, self._count = self._followed(), 0
            if dt != self._dt:
                self._weigh(dt)
        self._kept[self._count] = velocity
        self._count += 1

    def now(self, velocity: Floats) -> Floats:
        """Accelerations (n,); `velocity` (n,) are the speeds that were added last."""
        now: Floats = (velocity - self._followed()) / SMOOTHING
        return now

    def _followed(self) -> Floats:
        """The slow speed after all that was kept."""
        count = self._count
        followed: Floats = self._weights[_MANY - count :] @ self._kept[:count]
        followed += self._left[count] * self._slow
        return followed

    def _weigh(self, dt: float) -> None:
        """What becomes of the first slow speed after so many steps, and the weights of all kept."""
        share = dt / (dt + SMOOTHING)
        self._dt, self._left = dt, (1.0 - share) ** np.arange(_MANY + 1)
        self._weights = share * self._left[_MANY - 1 :: -1]
