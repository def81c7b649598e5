"""A simulated satellite receiver: x of the world is east, z is north.

In: the origin of the world on the globe, and the standard deviation of each coordinate in mm. Out:
a new fix ten times a second, independent of callers.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.description.scene import Triple
from robocomp_dsl.hardware.kinematics.geodesy import GeoPoint, offset
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.world.noise import NoiseLevel

_PERIOD = 0.1  # s


class Gps:
    """The device `name` on the body `body`."""

    def __init__(
        self, origin: GeoPoint, noise: float, body: str, level: NoiseLevel, *, name: str
    ) -> None:
        self._origin, self._noise, self._at, self._level = origin, noise, body, level
        self.name = name
        self._zero = np.zeros(3)

    def build(self, spec: Any) -> None:
        """Nothing to add."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the body and take the first fix."""
        self._random = random
        self.find(model, data)
        self._fix = self._measured()
        self._due = _PERIOD

    def find(self, model: Any, data: Any) -> None:
        """The same body in another model."""
        self._data = data
        self._body = int(model.body(self._at).id)

    def after_step(self, dt: float) -> None:
        """Take a fix when it is due."""
        if self._data.time >= self._due - dt / 2:
            self._due += _PERIOD
            self._fix = self._measured()

    def _measured(self) -> NDArray[np.float64]:
        """East, north, up in m."""
        spread = self._noise * MM * self._level.factor
        noise = spread * self._random.standard_normal(3)
        return np.array(self._data.xpos[self._body] + noise)

    def place(self) -> GeoPoint:
        """The position on the globe."""
        east, north, up = self._fix.tolist()
        return offset(self._origin, east, north, up)

    def position(self) -> Triple:
        """The position relative to the last reset, in mm."""
        east, north, up = ((self._fix - self._zero) / MM).tolist()
        return east, up, north

    def reset(self) -> None:
        """Make the current position the origin."""
        self._zero = self._fix
