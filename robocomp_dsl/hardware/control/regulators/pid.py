"""A bank of PID controllers, one per joint, computed together.

In: errors and their derivatives, (n,). Out: outputs within `max_output`. The integral is bounded
by `max_integral` and stops growing while the output is saturated. `loops` defines the errors and
their units.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import Bools, Floats, Ints


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains of one controller: output per error, per its integral, derivative, and reference."""

    kp: float = 0.0
    ki: float = 0.0
    kd: float = 0.0
    offset: float = 0.0
    max_output: float = np.inf
    max_integral: float = np.inf
    feedforward: float = 0.0

    def __post_init__(self) -> None:
        if not all(np.isfinite((self.kp, self.ki, self.kd, self.offset, self.feedforward))):
            raise BadValue("a gain must be a finite number")
        bounded = (self.kp, self.ki, self.kd, self.max_output, self.max_integral)
        if not all(value >= 0.0 for value in (*bounded, self.feedforward)):
            raise BadValue("gains and bounds must not be negative")


_COLUMNS = tuple(field.name for field in fields(Gains))


class PidBank:
    """The controllers; inactive ones output 0.

    `feedforward` (n,) are the feedforward gains. `tracks` is True if any error counts
    as a fault; `bounds` are those of outputs and integrals, (n,) each, `version` counts changes.
    """

    def __init__(self, gains: Sequence[Gains]) -> None:
        n = len(gains)
        self.integral, self.output, self.error = np.zeros(n), np.zeros(n), np.zeros(n)
        self.error_limit = np.full(n, np.inf)
        self.tracks = False
        self._before = self.integral
        self._dt = 0.001
        self.version = 0
        self._fed = np.zeros(n)
        self.configure(gains, np.ones(n, bool))

    def configure(self, gains: Sequence[Gains], works: Bools) -> None:
        """Set the gains, and the active controllers."""
        self.gains = list(gains)
        table = np.array([[getattr(g, name) for g in self.gains] for name in _COLUMNS])
        table[:, ~works] = 0.0
        self._columns = tuple(table[:4])
        self.bounds: tuple[Floats, Floats] = (table[4], table[5])
        self.feedforward = table[6]
        self._growth = self._columns[1] * self._dt
        self.version += 1
        self.integral = np.where(works, self.integral, 0.0)
        self.feed(self._fed)

    def feed(self, reference: Floats) -> None:
        """Feed constant references (n,) forward."""
        self._fed = reference
        self._constant = self._columns[3] + self.feedforward * reference
        self._shifted = bool(np.count_nonzero(self._constant))

    def set_error_limits(self, joints: Ints, error: Floats) -> None:
        """Error thresholds of tracking faults while a position is held; infinite: none."""
        if (error <= 0.0).any():
            raise BadValue("an error limit must be positive")
        self.error_limit[joints] = error
        self.tracks = bool(np.isfinite(self.error_limit).any())

    def reset(self, joints: Ints) -> None:
        """Reset the integrals of `joints`."""
        self.integral[joints] = 0.0

    def step(self, error: Floats, derivative: Floats, dt: float) -> Floats:
        """Outputs (n,); 0 for inactive controllers."""
        self.propose(error, derivative, dt)
        return self.bounded()

    def propose(
        self, error: Floats, derivative: Floats, dt: float, ahead: Floats | None = None
    ) -> Floats:
        """Outputs (n,) without bounds; call `bounded` if one is exceeded.

        `ahead` (n,) is the feedforward of this step.
        """
        kp, ki, kd, _ = self._columns
        if dt != self._dt:
            self._dt, self._growth = dt, ki * dt
        grown = self._growth * error
        grown += self.integral
        requested: Floats = kp * error
        requested += kd * derivative
        if self._shifted:
            requested += self._constant
        if ahead is not None:
            requested += self.feedforward * ahead
        requested += grown
        self._before, self.integral, self.output, self.error = (
            self.integral,
            grown,
            requested,
            error,
        )
        return requested

    def bounded(self) -> Floats:
        """The last outputs with all bounds applied."""
        bound, most = self.bounds
        grown = np.minimum(np.maximum(self.integral, -most), most)
        requested = self.output - self.integral + grown
        output: Floats = np.minimum(np.maximum(requested, -bound), bound)
        # anti-windup: the integral stops while the output is saturated
        held = (requested != output) & (grown * self.error > 0.0)
        self.integral = np.where(held, self._before, grown)
        self.output = output
        return output
