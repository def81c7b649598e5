"""What each regulator of a board has to make good: one error a joint, by the loop that works.

In: errors of position and velocity, references and sensors of torque. Out: errors (n,) and their
derivatives, in the units of the loops. What no regulator looks at is not worked out.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.loops import Loop, Loops


class Deviations:
    """`felt` (n,) are the torques that joints feel [N m].

    Whoever steps the board tells them, where `feels` says that a regulator looks at them. `mixed`
    tells whether any regulates something else than its position.
    """

    def __init__(self, size: int) -> None:
        none: Bools = np.zeros(size, bool)
        self.felt = np.zeros(size)
        self.mixed = self.feels = False
        self._position = self._torque = none
        self._fast = self._all_fast = self._damped = False
        self._before: Floats | None = None

    def choose(self, loops: Loops) -> None:
        """Follow the loops that work now."""
        self._position, self._torque = loops.works(Loop.POSITION), loops.works(Loop.TORQUE)
        fast, gains = loops.works(Loop.VELOCITY), loops.bank.gains
        self._fast = bool(fast.any())
        self._all_fast = self._fast and not self._position.any()
        self.mixed = self._fast or bool(self._torque.any())
        looks = np.array([bool(one.kp or one.ki or one.kd) for one in gains])
        self.feels = bool((self._torque & looks).any())
        damps = np.array([bool(one.kd) for one in gains])
        self._damped = bool((damps & (fast | self._torque)).any())
        self._before = None

    def of(self, error: Floats, late: Floats, torque: Floats, dt: float) -> tuple[Floats, Floats]:
        """Errors and derivatives (n,); `error` and `late` are those of position and velocity.

        `torque` are references. Where no gain looks at it, anything stands.
        """
        mixed = error
        if self._fast:
            mixed = late if self._all_fast else np.where(self._position, error, late)
        if self.feels:
            mixed = np.where(self._torque, torque - self.felt, mixed)
        if not self._damped:
            return mixed, late  # a derivative that meets a gain is that of a position
        before, self._before = mixed if self._before is None else self._before, mixed
        return mixed, np.where(self._position, late, (mixed - before) / dt)
