"""A range finder of a model file: the distance of an object along the z axis of its site."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from robocomp_dsl.hardware.kinematics.planar import Pose, wrap_angle
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.world.noise import NoiseLevel

_PERIOD = 0.05
"""Time between two error samples [s]: readings in between have the same error."""


class RangeFinder:
    """The sensor `sensor` of the file as the device `name`; `noise` and `farthest` are in mm.

    `farthest` is its reading without an object.
    """

    def __init__(
        self, sensor: str, farthest: float, noise: float, level: NoiseLevel, *, name: str
    ) -> None:
        self._sensor, self._farthest = sensor, farthest
        self._noise, self._level = noise, level
        self._error = 0.0
        self.name = name

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Nothing to add: the file has the sensor."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the sensor, and draw its first error."""
        self._random, self._due = random, 0.0
        self.find(model, data)
        self.after_step(0.0)

    def find(self, model: Any, data: Any) -> None:
        """The same sensor in another model."""
        self._data, sensor = data, model.sensor(self._sensor)
        self._at, self._site = int(sensor.adr[0]), int(sensor.objid[0])
        self._robot = int(model.body_rootid[model.site_bodyid[self._site]])

    def after_step(self, dt: float) -> None:
        """Draw a new error when it is due."""
        if self._noise and self._data.time >= self._due - dt / 2:
            self._due += _PERIOD
            self._error = float(self._random.standard_normal())

    # -- as a device --------------------------------------------------------------------------

    def distance(self) -> float:
        """Distance of the nearest object after the latest step, in mm."""
        seen = float(self._data.sensordata[self._at]) / MM
        if seen < 0:  # MuJoCo's value without an object
            return self._farthest
        seen += self._noise * self._level.factor * self._error
        return min(max(seen, 0.0), self._farthest)

    def mounted(self) -> Pose:
        """Its position and direction on the root body."""
        data = self._data
        robot = axes.pose(data.xpos[self._robot], data.xmat[self._robot])
        x, y, _ = data.site_xpos[self._site].tolist()
        along = data.site_xmat[self._site].tolist()
        looks = wrap_angle(math.atan2(along[2], along[5]))
        return robot.inverse().then(Pose(x / MM, y / MM, looks))
