"""Control errors: one error per joint, by its active loop.

In: position and velocity errors, torque references and readings. Out: errors (n,) and their
derivatives, in the units of the loops. An error that no controller uses is not computed.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.regulators.loops import ControlLoops, Loop


class ControlErrors:
    """`measured_torque` (n,) are the torques at the joints [N m].

    The caller of `Board.step` sets them while `needs_torque`, when a controller uses them.
    `beyond_position` is True while a loop other than position is active.
    """

    def __init__(self, size: int) -> None:
        none: Bools = np.zeros(size, bool)
        self.measured_torque = np.zeros(size)
        self.beyond_position = self.needs_torque = False
        self._position = self._torque = none
        self._fast = self._all_fast = self._damped = False
        self._before: Floats | None = None

    def configure(self, loops: ControlLoops) -> None:
        """Update the active loops."""
        self._position, self._torque = loops.works(Loop.POSITION), loops.works(Loop.TORQUE)
        fast, gains = loops.works(Loop.VELOCITY), loops.bank.gains
        self._fast = bool(fast.any())
        self._all_fast = self._fast and not self._position.any()
        self.beyond_position = self._fast or bool(self._torque.any())
        looks = np.array([bool(gain.kp or gain.ki or gain.kd) for gain in gains])
        self.needs_torque = bool((self._torque & looks).any())
        damps = np.array([bool(gain.kd) for gain in gains])
        self._damped = bool((damps & (fast | self._torque)).any())
        self._before = None

    def compute(
        self, error: Floats, late: Floats, torque: Floats, dt: float
    ) -> tuple[Floats, Floats]:
        """Errors and derivatives (n,); `error` and `late` are the errors of position and velocity.

        `torque` are references. A value without a gain is arbitrary.
        """
        beyond_position = error
        if self._fast:
            beyond_position = late if self._all_fast else np.where(self._position, error, late)
        if self.needs_torque:
            beyond_position = np.where(self._torque, torque - self.measured_torque, beyond_position)
        if not self._damped:
            return beyond_position, late  # only position controllers have a derivative gain
        before, self._before = (
            beyond_position if self._before is None else self._before,
            beyond_position,
        )
        return beyond_position, np.where(self._position, late, (beyond_position - before) / dt)
