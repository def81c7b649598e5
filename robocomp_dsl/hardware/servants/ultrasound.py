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
        """Configuration of the bus."""
        return self.types.BusParams(numSensors=len(self.ids), basicPeriod=_PERIOD_MS)

    def getSensorParams(self, sensor: str) -> Any:
        """Configuration of one sensor."""
        self._known(sensor)
        return self.types.SensorParams(device=self.port, busId=self.ids.index(sensor), name=sensor)

    def getAllSensorParams(self) -> list[Any]:
        """Configuration of all sensors."""
        return [self.getSensorParams(sensor) for sensor in self.ids]

    def getAllSonarPose(self) -> Any:
        """Mounting poses on the robot: x to the right, y ahead."""
        poses = [self._known(sensor).mounted() for sensor in self.ids]
        return self.types.SonarPoseList(
            [self.types.SonarPose(sensor.x, sensor.z, sensor.alpha) for sensor in poses]
        )

    def getSonarsNumber(self) -> int:
        """Number of sensors."""
        return len(self.ids)

    def getSensorDistance(self, sensor: str) -> int:
        """The distance measured by one sensor, in mm."""
        distance: float = self._known(sensor).distance()
        return round(distance)

    def getAllSensorDistances(self) -> Any:
        """The distances measured by all sensors, in mm."""
        return np.array([self.getSensorDistance(sensor) for sensor in self.ids], dtype=np.int32)

    def _known(self, sensor: str) -> Any:
        if sensor not in self.ids:
            raise DeviceGone(f"there is no sensor `{sensor}`: {', '.join(self.ids)}")
        return self.device(sensor)
