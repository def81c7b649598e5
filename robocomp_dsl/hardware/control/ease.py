"""Whether all joints of a board are at ease: nowhere near a bound, so that none need be worked out.

In: the limits and the regulators, and what a step has come to. Out: yes or no, by one look at all
of it: numpy needs hardly longer for five rows than for one, and joints are at ease nearly always.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Floats
from robocomp_dsl.hardware.control.limits import AHEAD, Limits
from robocomp_dsl.hardware.control.pid import PidBank


class Ease:
    """The bounds of `limits` and `pid`, one after the other, as long as they do not change."""

    def __init__(self, limits: Limits, pid: PidBank) -> None:
        n = len(limits.speed)
        self._limits, self._pid = limits, pid
        self._seen = (-1, -1)
        self._ahead = np.full(n, AHEAD)
        # five rows and the same with the other sign, so that one comparison does for both sides
        self._every, self._most = np.zeros((2, 5, n)), np.zeros((2, 5, n))
        self._said = bytearray(10 * n)  # in bytes a search for any false is a matter of nothing
        self._within = np.frombuffer(self._said, bool).reshape(2, 5, n)
        self._plus, self._minus = self._every[0], self._every[1]
        self._rows = tuple(self._plus)

    def __reduce__(self) -> tuple[type[Ease], tuple[Limits, PidBank]]:
        """A copy writes to rows of its own."""
        return Ease, (self._limits, self._pid)

    def holds(self, position: Floats, velocity: Floats, torque: Floats) -> bool:
        """For all joints; `torque` (n,) is what is wished. Never where something is no number."""
        limits, pid = self._limits, self._pid
        if self._seen != (limits.version, pid.version):
            self._look()
        ahead, speed, wished, output, integral = self._rows
        np.multiply(velocity, self._ahead, ahead)
        ahead += position
        speed[:] = velocity
        wished[:] = torque
        output[:] = pid.output
        integral[:] = pid.integral
        np.negative(self._plus, self._minus)
        np.less_equal(self._every, self._most, self._within)
        return 0 not in self._said

    def _look(self) -> None:
        limits, pid = self._limits, self._pid
        low, high = limits.stops
        self._most[:, 1:] = (limits.speed, limits.torque, *pid.bounds)
        self._most[:, 0] = high, -low
        self._seen = limits.version, pid.version
