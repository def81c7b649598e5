"""A bank of PID regulators, one per joint, computed together.

In: errors and their derivatives, (n,). Out: outputs within `max_output`. The integral is bounded
by `max_integral` and stops growing while the output is at its bound.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import BoardSpec, Floats, Ints


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
        Gains(10 * t, 5 * t, 0.5 * t, max_output=t, max_integral=0.5 * t)
        for t in (joint.torque_limit for joint in spec.joints)
    )


class PidBank:
    """The regulators; `enabled` (n,) may be switched joint by joint."""

    def __init__(self, gains: tuple[Gains, ...]) -> None:
        self.gains = list(gains)
        self.enabled = np.ones(len(gains), bool)
        self.integral = np.zeros(len(gains))
        self.output = np.zeros(len(gains))
        self.error = np.zeros(len(gains))
        self.error_limit = np.full(len(gains), np.inf)
        self._columns = self._table()

    def set(self, joint: int, gains: Gains) -> None:
        """Give one regulator other gains."""
        self.gains[joint] = gains
        self._columns = self._table()

    def set_offset(self, joint: int, offset: float) -> None:
        """Give one regulator another constant output."""
        self.set(joint, replace(self.gains[joint], offset=offset))

    def reset(self, joints: Ints) -> None:
        """Forget the integrals of `joints`."""
        self.integral[joints] = 0.0

    def step(self, error: Floats, derivative: Floats, dt: float, factor: Floats) -> Floats:
        """Outputs (n,). `factor` (n,) is 1 where a regulator is in use and 0 where it is not."""
        kp, ki, kd, offset, bound, most = self._columns
        used = factor * self.enabled
        grown = self.integral + ki * error * dt
        np.minimum(np.maximum(grown, -most), most, out=grown)
        grown *= used
        wanted = (kp * error + kd * derivative + offset) * used + grown
        output: Floats = np.minimum(np.maximum(wanted, -bound), bound)
        # an output at its bound must not wind the integral up any further
        held = (wanted != output) & (grown * error > 0.0)
        np.copyto(self.integral, grown, where=~held)
        self.output, self.error = output, error * used
        return output

    def _table(self) -> Floats:
        return np.array([[getattr(g, name) for g in self.gains] for name in _COLUMNS])
