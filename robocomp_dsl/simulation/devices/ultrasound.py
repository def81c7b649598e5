"""A simulated ultrasonic range finder: the shortest of a fan of rays, with noise."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from robocomp_dsl.hardware.devices.laser import LaserSettings
from robocomp_dsl.hardware.kinematics.planar import Pose
from robocomp_dsl.simulation.devices.laser import Laser, LaserMount
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.world.noise import NoiseLevel


class Ultrasound(Laser):
    """The device; `settings.noise` is that of the distance."""

    def __init__(
        self, settings: LaserSettings, body: str, level: NoiseLevel, *, name: str, carrier: str
    ) -> None:
        quiet = replace(settings, noise=0.0)
        super().__init__(quiet, LaserMount(body, 0.0, 0.0, 0.0), name=name, carrier=carrier)
        self._spread, self._shared = settings.noise, level
        self._echo: tuple[object, float] = (None, settings.max_range)

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find its site and take the first measurement."""
        super().bind(model, data, random)
        self._measure_echo()

    def after_step(self, dt: float) -> None:
        """Measure when it is due."""
        super().after_step(dt)
        if self._echo[0] is not self._scan:
            self._measure_echo()

    def _measure_echo(self) -> None:
        low, high = self.settings.min_range, self.settings.max_range
        nearest = float(self._scan.distances.min())
        if nearest < high:
            nearest += self._spread * self._shared.factor * float(self._random.standard_normal())
        self._echo = (self._scan, min(max(nearest, low), high))

    def distance(self) -> float:
        """The distance of the nearest object in its cone, in mm."""
        return self._echo[1]

    def mounted(self) -> Pose:
        """Its mounting pose on the robot."""
        data, body = self._data, int(self._model.body(self._carrier).id)
        robot = axes.pose(data.xpos[body], data.xmat[body])
        own = axes.pose(data.site_xpos[self._site], data.site_xmat[self._site])
        return robot.inverse().then(own)
