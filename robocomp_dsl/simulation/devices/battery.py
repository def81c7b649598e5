"""A simulated battery, discharged by the motors and a constant load.

In: the capacity (Wh), the voltage (V) and the load at rest (W). Out: the remaining charge. Motors
recover no energy when they brake.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from robocomp_dsl.hardware.devices.battery import Charge

_HOUR = 3600.0  # s


class Battery:
    """The device `name`; it powers all motors of the world."""

    def __init__(self, capacity: float, voltage: float, idle: float, *, name: str) -> None:
        self._capacity, self._voltage, self._idle = capacity * _HOUR, voltage, idle
        self.name = name

    def build(self, spec: Any) -> None:
        """Nothing to add."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002
        """Start with a full battery."""
        self._left = self._capacity
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:  # noqa: ARG002
        """The same battery in another model."""
        self._data = data

    def after_step(self, dt: float) -> None:
        """Subtract the energy used."""
        self._left = max(self._left - self._power() * dt, 0.0)

    def _power(self) -> float:
        data = self._data
        moved = np.maximum(data.actuator_force * data.actuator_velocity, 0.0)
        return self._idle + float(moved.sum())

    def charge(self) -> Charge:
        """The current state."""
        power = self._power()
        return Charge(
            self._left / self._capacity,
            self._voltage if self._left else 0.0,
            power,
            self._left / power if power > 0 else math.inf,
        )
