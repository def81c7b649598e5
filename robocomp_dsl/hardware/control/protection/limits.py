"""Limits on position, speed and torque, applied before anything reaches a motor.

In: requested values. Out: permitted values. Positions are clipped when commanded and during the
motion; a torque that would push a joint past a limit at its current speed is removed, and a spring
moves the joint back; a torque that would exceed the speed limit is removed as well.
"""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import BoardSpec, Bools, Floats, Ints

_SPRING = 20.0
"""Stiffness of the soft stops, in torque limits per rad."""

AHEAD = 0.05
"""Look-ahead time of the soft stops for fast joints [s]."""

_FAST = 0.5
"""A slower joint is only stopped at its limit [rad/s]."""


class JointLimits:
    """All arrays (n,): `low`, `high` [rad], `speed` [rad/s], `torque` [N m].

    `stops` are `low` and `high` if the encoder is calibrated; `version` counts changes.
    """

    def __init__(self, spec: BoardSpec) -> None:
        self.low, self.high = spec.column("low"), spec.column("high")
        self.speed, self.torque = spec.column("speed_limit"), spec.column("torque_limit")
        self.version = 0
        self._widest = self.low.copy(), self.high.copy()
        self._trusted = np.ones(len(self.low), bool)
        self._check(self.low, self.high)
        self._place_stops()

    def trust(self, calibrated: Bools) -> None:
        """Whether the encoders (n,) are calibrated; other joints have no soft stops."""
        self._trusted = calibrated
        self._place_stops()

    def set_position(self, joints: Ints, low: Floats, high: Floats) -> None:
        """Narrow the range of `joints`; limits beyond the mechanical range are rejected."""
        self._check(low, high)
        if (low < self._widest[0][joints]).any() or (high > self._widest[1][joints]).any():
            raise BadValue("position limits may be narrowed, not be wider than the joint's own")
        self.low[joints], self.high[joints] = low, high
        self._place_stops()

    def set_speed(self, joints: Ints, speed: Floats) -> None:
        """Set the maximum speeds of `joints`."""
        if (speed <= 0.0).any():
            raise BadValue("a speed limit must be positive")
        self.speed[joints] = speed
        self.version += 1

    def clip(self, joints: Ints, position: Floats) -> tuple[Floats, Bools]:
        """Positions clipped to the limits, and which were clipped."""
        allowed = np.clip(position, self.low[joints], self.high[joints])
        return allowed, allowed != position

    def guard(self, q: Floats, dq: Floats, torque: Floats) -> Floats:
        """Torques (n,) within all limits, from requested torques at `q` with speed `dq`."""
        low, high = self.stops
        ahead = q + AHEAD * dq
        past = ahead - np.minimum(np.maximum(ahead, low), high)
        fast = np.abs(dq) > self.speed
        if np.count_nonzero(past):
            # a slow joint is only stopped beyond its limit
            there = (q < low) | (q > high) | (np.abs(dq) > _FAST)
            back = -self.torque * _SPRING * past
            torque = np.where(there & (past > 0.0), np.minimum(torque, back), torque)
            torque = np.where(there & (past < 0.0), np.maximum(torque, back), torque)
        if np.count_nonzero(fast):
            torque = np.where(fast & (torque * dq > 0.0), 0.0, torque)
        bounded: Floats = np.minimum(np.maximum(torque, -self.torque), self.torque)
        return bounded

    def _place_stops(self) -> None:
        low = np.where(self._trusted, self.low, -np.inf)
        high = np.where(self._trusted, self.high, np.inf)
        self.stops = low, high
        self.version += 1

    @staticmethod
    def _check(low: Floats, high: Floats) -> None:
        if (low >= high).any():
            raise BadValue("a lower position limit must lie below the upper one")
