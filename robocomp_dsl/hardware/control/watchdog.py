"""A watchdog on what is pushed: torques, duty cycles and currents that somebody sends in a stream.

In: when a reference came, and for which joints. Out: the joints whose pusher has been silent for
too long. Joints that share motors are fed together, since they change their mode together.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import BoardSpec, Ints
from robocomp_dsl.hardware.control.modes import Mode

PUSHED = (Mode.TORQUE, Mode.PWM, Mode.CURRENT)
"""Modes that go on doing what they were told last, whatever comes of it."""


class Watchdog:
    """`timeout` is how long a pusher may be silent [s], infinite: for ever.

    `due` is the time [s] at which the first joint will have waited too long.
    """

    def __init__(self, spec: BoardSpec) -> None:
        n = len(spec.joints)
        self.timeout = self.due = np.inf
        self._since = np.full(n, np.inf)  # when the last reference came; infinite: none is awaited
        self._together = np.zeros((n, n), bool)
        for joint in range(n):
            self._together[joint, spec.coupled(joint)] = True
        self._apart = int(self._together.sum()) == n

    def set_timeout(self, seconds: float) -> None:
        """Be as patient from now on; 0: for ever. Raises `BadValue`."""
        if not 0.0 <= seconds < np.inf:
            raise BadValue(f"a time of silence is 0 s or longer, not {seconds:g}")
        self.timeout = seconds or np.inf
        self._look()

    def feed(self, joints: Ints, time: float) -> None:
        """References for `joints` came at `time`."""
        fed = joints if self._apart else self._together[joints].any(axis=0)
        self._since[fed] = time
        self._look()

    def follow(self, joints: Ints, modes: list[Mode], time: float) -> None:
        """From `time` on `joints` are in these `modes`: references are awaited, or no longer."""
        self._since[joints] = [time if mode in PUSHED else np.inf for mode in modes]
        self._look()

    def silent(self, time: float) -> Ints:
        """The joints that have waited too long at `time`."""
        return np.flatnonzero(self._since + self.timeout <= time)

    def _look(self) -> None:
        if self.timeout < np.inf:
            self.due = float((self._since + self.timeout).min(initial=np.inf))
        else:
            self.due = np.inf
