"""`IMU` over an inertial unit: roll about z (ahead), pitch about x, yaw about y (up)."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any

from robocomp_dsl.hardware.devices.imu import ImuDevice
from robocomp_dsl.hardware.servants.servant import Servant


class ImuServant(Servant):
    """One unit."""

    @property
    def _imu(self) -> ImuDevice:
        found: ImuDevice = self.device()
        return found

    def getDataImu(self) -> Any:
        """All measurements."""
        types, it = self.types, self._imu.measure()
        rx, ry, rz = it.orientation
        return types.DataImu(
            acc=types.Acceleration(*it.acceleration),
            gyro=types.Gyroscope(*it.angular_velocity),
            mag=types.Magnetic(*it.field),
            rot=types.Orientation(Roll=rz, Pitch=rx, Yaw=ry),
            temperature=it.temperature,
        )

    def getAcceleration(self) -> Any:
        """Linear acceleration, gravity included."""
        return self.getDataImu().acc

    def getAngularVel(self) -> Any:
        """Angular velocity."""
        return self.getDataImu().gyro

    def getMagneticFields(self) -> Any:
        """Magnetic field."""
        return self.getDataImu().mag

    def getOrientation(self) -> Any:
        """Orientation."""
        return self.getDataImu().rot

    def resetImu(self) -> None:
        """Make the current orientation the reference."""
        self._imu.reset()
