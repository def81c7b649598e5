"""`GPS` over a satellite receiver."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from robocomp_dsl.hardware.devices.gps import GpsDevice
from robocomp_dsl.hardware.kinematics.geodesy import utm
from robocomp_dsl.hardware.servants.servant import Servant


class GpsServant(Servant):
    """One receiver, which always has a fix."""

    @property
    def _gps(self) -> GpsDevice:
        found: GpsDevice = self.device()
        return found

    def getData(self) -> tuple[bool, float, float, float]:
        """Latitude, longitude and altitude."""
        it = self._gps.place()
        return True, it.latitude, it.longitude, it.altitude

    def getPos(self) -> tuple[bool, float, float, float]:
        """Position relative to the last reset, in mm."""
        return (True, *self._gps.position())

    def getUTMData(self) -> tuple[bool, int, str, float, float]:
        """Position in the UTM projection."""
        return (True, *utm(self._gps.place()))

    def resetPos(self) -> None:
        """Make the current position the origin."""
        self._gps.reset()
