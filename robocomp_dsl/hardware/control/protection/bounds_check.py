"""Checks whether a step of a board is within all bounds, so that clipping can be skipped.

In: the limits, the controllers and the results of a step. Out: a bool, from a single comparison of
all values: numpy is about as fast for five rows as for one, and most steps are within bounds.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats
from robocomp_dsl.hardware.control.protection.limits import AHEAD, JointLimits
from robocomp_dsl.hardware.control.regulators.pid import PidBank


class BoundsCheck:
    """The concatenated bounds of `limits` and `pid`, cached until they change."""

    def __init__(self, limits: JointLimits, pid: PidBank) -> None:
        n = len(limits.speed)
        self._limits, self._pid = limits, pid
        self._versions = (-1, -1)
        self._ahead = np.full(n, AHEAD)
        # five rows, and the same negated, so that one comparison checks both sides
        self._values, self._bounds = np.zeros((2, 5, n)), np.zeros((2, 5, n))
        self._result = bytearray(10 * n)  # searching bytes for a false value takes almost no time
        self._within = np.frombuffer(self._result, bool).reshape(2, 5, n)
        self._plus, self._minus = self._values[0], self._values[1]
        self._rows = tuple(self._plus)

    def __reduce__(self) -> tuple[type[BoundsCheck], tuple[JointLimits, PidBank]]:
        """A copy with rows of its own."""
        return BoundsCheck, (self._limits, self._pid)

    def within_bounds(self, position: Floats, velocity: Floats, torque: Floats) -> bool:
        """For all joints; `torque` (n,) is the requested torque. False if a value is NaN."""
        limits, pid = self._limits, self._pid
        if self._versions != (limits.version, pid.version):
            self._read_bounds()
        ahead, speed, wished, output, integral = self._rows
        np.multiply(velocity, self._ahead, ahead)
        ahead += position
        speed[:] = velocity
        wished[:] = torque
        output[:] = pid.output
        integral[:] = pid.integral
        np.negative(self._plus, self._minus)
        np.less_equal(self._values, self._bounds, self._within)
        return 0 not in self._result

    def _read_bounds(self) -> None:
        limits, pid = self._limits, self._pid
        low, high = limits.stops
        self._bounds[:, 1:] = (limits.speed, limits.torque, *pid.bounds)
        self._bounds[:, 0] = high, -low
        self._versions = limits.version, pid.version
