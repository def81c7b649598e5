"""A watchdog on streamed references: torques, duty cycles and currents.

In: the time and the joints of each reference. Out: the joints whose references have timed out.
Joints that share motors count as one, since they change their mode together.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import BoardSpec, Ints
from robocomp_dsl.hardware.control.modes import Mode

STREAMED_MODES = (Mode.TORQUE, Mode.PWM, Mode.CURRENT)
"""Modes that need a stream of references: the motor would keep the last one."""


class Watchdog:
    """`timeout` is the longest time between references [s]; infinite: no limit.

    `due` is the time [s] at which the first joint times out.
    """

    def __init__(self, spec: BoardSpec) -> None:
        n = len(spec.joints)
        self.timeout = self.due = np.inf
        self._since = np.full(n, np.inf)  # time of the last reference; infinite: none is expected
        self._together = np.zeros((n, n), bool)
        for joint in range(n):
            self._together[joint, spec.coupled(joint)] = True
        self._apart = int(self._together.sum()) == n

    def set_timeout(self, seconds: float) -> None:
        """Set the time-out; 0: none. Raises `BadValue`."""
        if not 0.0 <= seconds < np.inf:
            raise BadValue(f"a time-out is 0 s or longer, not {seconds:g}")
        self.timeout = seconds or np.inf
        self._update_due()

    def feed(self, joints: Ints, time: float) -> None:
        """Record references for `joints` at `time`."""
        fed = joints if self._apart else self._together[joints].any(axis=0)
        self._since[fed] = time
        self._update_due()

    def follow(self, joints: Ints, modes: list[Mode], time: float) -> None:
        """Record mode changes at `time`: references of `joints` are expected, or not."""
        self._since[joints] = [time if mode in STREAMED_MODES else np.inf for mode in modes]
        self._update_due()

    def expired(self, time: float) -> Ints:
        """The joints that have timed out at `time`."""
        return np.flatnonzero(self._since + self.timeout <= time)

    def _update_due(self) -> None:
        if self.timeout < np.inf:
            self.due = float((self._since + self.timeout).min(initial=np.inf))
        else:
            self.due = np.inf
