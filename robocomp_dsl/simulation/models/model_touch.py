"""A touch sensor of a model file: the contact forces within its site, in N."""

from __future__ import annotations

from typing import Any

import numpy as np


class ModelTouch:
    """The sensor `sensor` of the file as the device `name`."""

    def __init__(self, sensor: str, *, name: str) -> None:
        self._sensor = sensor
        self.name = name

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Nothing to add: the file has the sensor."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002
        """Find the sensor."""
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:
        """The same sensor in another model."""
        self._data = data
        self._at = int(model.sensor(self._sensor).adr[0])

    # -- as a device --------------------------------------------------------------------------

    def value(self) -> float:
        """The sum of the normal forces after the latest step."""
        return float(self._data.sensordata[self._at])
