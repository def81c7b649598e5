"""A bank of PID regulators, one per joint, computed together.

In: errors and their derivatives, (n,). Out: outputs within `max_output`. The integral is bounded
by `max_integral` and stops growing while the output is at its bound.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import BoardSpec, Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains of one regulator; output [N m] per error [rad], per integral and per derivative."""

    kp: float = 0.0
    ki: float = 0.0
    kd: float = 0.0
    offset: float = 0.0
    max_output: float = np.inf
    max_integral: float = np.inf

    def __post_init__(self) -> None:
        if not all(np.isfinite((self.kp, self.ki, self.kd, self.offset))):
            raise BadValue("a gain must be a finite number")
        bounded = (self.kp, self.ki, self.kd, self.max_output, self.max_integral)
        if not all(value >= 0.0 for value in bounded):
            raise BadValue("gains and bounds must not be negative")


_COLUMNS = tuple(one.name for one in fields(Gains))


def default_gains(spec: BoardSpec) -> tuple[Gains, ...]:
    """Position gains in proportion to the joint's torque: all of it at 0.1 rad of error."""
    return tuple(
        Gains(10 * t, 20 * t, 0.5 * t, max_output=t, max_integral=0.5 * t)
        for t in (joint.torque_limit for joint in spec.joints)
    )


class PidBank:
    """The regulators; each works where it is both enabled by the user and in use by the law.

    `tracks` tells whether any error counts as a fault; `bounds` are those of outputs and of
    integrals, (n,) each, and `version` counts their changes.
    """

    def __init__(self, gains: tuple[Gains, ...]) -> None:
        n = len(gains)
        self.gains = list(gains)
        self.integral, self.output, self.error = np.zeros(n), np.zeros(n), np.zeros(n)
        self.error_limit = np.full(n, np.inf)
        self.tracks = False
        self._before = self.integral
        self._dt = 0.001
        self.version = 0
        self.enabled: Bools = np.ones(n, bool)
        self._in_use: Bools = np.ones(n, bool)
        self._prepare()

    def set(self, joint: int, gains: Gains) -> None:
        """Give one regulator other gains."""
        self.gains[joint] = gains
        self._prepare()

    def set_offset(self, joint: int, offset: float) -> None:
        """Give one regulator another constant output."""
        self.set(joint, replace(self.gains[joint], offset=offset))

    def set_error_limits(self, joints: Ints, error: Floats) -> None:
        """Errors that are faults where a position is held; infinite: none is."""
        if (error <= 0.0).any():
            raise BadValue("an error limit must be positive")
        self.error_limit[joints] = error
        self.tracks = bool(np.isfinite(self.error_limit).any())

    def enable(self, joints: Ints, on: bool) -> None:
        """Switch regulators on or off; one that is off gives 0."""
        self.enabled[joints] = on
        self._prepare()

    def use(self, in_use: Bools) -> None:
        """Which regulators (n,) the control law needs now."""
        self._in_use = in_use
        self._prepare()

    def reset(self, joints: Ints) -> None:
        """Forget the integrals of `joints`."""
        self.integral[joints] = 0.0

    def step(self, error: Floats, derivative: Floats, dt: float) -> Floats:
        """Outputs (n,); 0 where a regulator does not work."""
        self.propose(error, derivative, dt)
        return self.bounded()

    def propose(self, error: Floats, derivative: Floats, dt: float) -> Floats:
        """Outputs (n,) as if there were no bounds; `bounded` is due where one is passed."""
        kp, ki, kd, offset = self._columns
        if dt != self._dt:
            self._dt, self._growth = dt, ki * dt
        grown = self._growth * error
        grown += self.integral
        wanted: Floats = kp * error
        wanted += kd * derivative
        if self._shifted:
            wanted += offset
        wanted += grown
        self._before, self.integral, self.output, self.error = self.integral, grown, wanted, error
        return wanted

    def bounded(self) -> Floats:
        """The outputs just proposed, with all bounds."""
        bound, most = self.bounds
        grown = np.minimum(np.maximum(self.integral, -most), most)
        wanted = self.output - self.integral + grown
        output: Floats = np.minimum(np.maximum(wanted, -bound), bound)
        # an output at its bound must not wind the integral up
        held = (wanted != output) & (grown * self.error > 0.0)
        self.integral = np.where(held, self._before, grown)
        self.output = output
        return output

    def _prepare(self) -> None:
        """Gains as columns, zero where a regulator does not work."""
        table = np.array([[getattr(g, name) for g in self.gains] for name in _COLUMNS])
        works = self.enabled & self._in_use
        table[:, ~works] = 0.0
        self._columns = tuple(table[:4])
        self.bounds: tuple[Floats, Floats] = (table[4], table[5])
        self._shifted = bool(table[3].any())
        self._growth = self._columns[1] * self._dt
        self.version += 1
        self.integral = np.where(works, self.integral, 0.0)
