"""`Laser` over a range finder, with the base that carries it, if any."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

import math
from typing import Any

from robocomp_dsl.hardware.devices.laser import LaserDevice, LaserSettings, Scan
from robocomp_dsl.hardware.servants.base import base_state_to_message
from robocomp_dsl.hardware.servants.servant import Servant


class LaserServant(Servant):
    """The first device of the port is the laser, the second, if any, the base under it."""

    @property
    def _laser(self) -> LaserDevice:
        found: LaserDevice = self.device()
        return found

    _last_published: object = None

    def poll(self) -> list[tuple[Any, ...]]:
        """The latest scan, if it has not been published yet."""
        scan = self._laser.scan()
        if scan is self._last_published:
            return []
        self._last_published = scan
        return [(self._data(scan),)]

    def getLaserData(self) -> Any:
        """The latest scan."""
        return self._data(self._laser.scan())

    def _data(self, scan: Scan) -> Any:
        return self.types.TLaserData.from_columns(angle=scan.angles, dist=scan.distances)

    def getLaserAndBStateData(self) -> tuple[Any, Any]:
        """The latest scan, and the state of the base; all zero without a base."""
        state = self.types.TBaseState
        base = (
            base_state_to_message(state, self.device(self.ids[1]).state())
            if self.ids[1:]
            else state()
        )
        return self.getLaserData(), base

    def getLaserConfData(self) -> Any:
        """Configuration of the laser."""
        return settings_to_message(self.types.LaserConfData, self.ids[0], self._laser.settings)


def settings_to_message(struct: type[Any], name: str, settings: LaserSettings) -> Any:
    """The settings of the laser `name` as an instance of `struct`."""
    half = settings.degrees / 2
    return struct(
        driver="robocomp_dsl",
        device=name,
        staticConf=1,
        maxMeasures=settings.measures,
        maxDegrees=math.ceil(settings.degrees),
        maxRange=round(settings.max_range),
        minRange=round(settings.min_range),
        iniRange=-math.ceil(half),
        endRange=math.ceil(half),
        cluster=1,
        sampleRate=round(settings.period * 1000),
        angleRes=settings.degrees / max(settings.measures - 1, 1),
        angleIni=-half,
    )
