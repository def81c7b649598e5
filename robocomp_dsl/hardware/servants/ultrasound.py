"""`Ultrasound` over range finders: one port for all of them."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.devices.errors import DeviceGone, HardwareError
from robocomp_dsl.hardware.servants.servant import Servant

_PERIOD_MS = 50


class UltrasoundServant(Servant):
    """The sensors of the port, in order."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (DeviceGone, "UnknownSensorException"),
        (HardwareError, "HardwareFailedException"),
    )

    def getBusParams(self) -> Any:
        """The bus."""
        return self.types.BusParams(numSensors=len(self.ids), basicPeriod=_PERIOD_MS)

    def getSensorParams(self, sensor: str) -> Any:
        """How one sensor is set up."""
        self._known(sensor)
        return self.types.SensorParams(device=self.port, busId=self.ids.index(sensor), name=sensor)

    def getAllSensorParams(self) -> list[Any]:
        """How all sensors are set up."""
        return [self.getSensorParams(sensor) for sensor in self.ids]

    def getAllSonarPose(self) -> Any:
        """Where they sit on the robot: x to the right, y ahead."""
        poses = [self._known(sensor).mounted() for sensor in self.ids]
        return self.types.SonarPoseList(
            [self.types.SonarPose(sensor.x, sensor.z, sensor.alpha) for sensor in poses]
        )

    def getSonarsNumber(self) -> int:
        """How many there are."""
        return len(self.ids)

    def getSensorDistance(self, sensor: str) -> int:
        """What one of them measures, in mm."""
        distance: float = self._known(sensor).distance()
        return round(distance)

    def getAllSensorDistances(self) -> Any:
        """What all of them measure, in mm."""
        return np.array([self.getSensorDistance(sensor) for sensor in self.ids], dtype=np.int32)

    def _known(self, sensor: str) -> Any:
        if sensor not in self.ids:
            raise DeviceGone(f"there is no sensor `{sensor}`: {', '.join(self.ids)}")
        return self.device(sensor)
