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
        self._limits, self._pid = limits, pid
        self._seen = (-1, -1)
        self._low = self._high = np.zeros(0)
        size = 5 * len(limits.speed)
        self._every, self._kept, self._same = np.empty(size), np.empty(size), np.empty(size, bool)

    def holds(self, position: Floats, velocity: Floats, torque: Floats) -> bool:
        """For all joints; `torque` (n,) is what is wished."""
        limits, pid = self._limits, self._pid
        if self._seen != (limits.version, pid.version):
            self._look()
        every, kept, same = self._every, self._kept, self._same
        ahead = AHEAD * velocity
        ahead += position
        np.concatenate((ahead, velocity, torque, pid.output, pid.integral), out=every)
        np.maximum(every, self._low, out=kept)
        np.minimum(kept, self._high, out=kept)
        np.equal(kept, every, out=same)
        return b"\0" not in same.tobytes()  # the fastest way to ask whether all are true

    def _look(self) -> None:
        limits, pid = self._limits, self._pid
        low, high = limits.stops
        most = np.concatenate((limits.speed, limits.torque, *pid.bounds))
        self._low, self._high = np.concatenate((low, -most)), np.concatenate((high, most))
        self._seen = limits.version, pid.version
