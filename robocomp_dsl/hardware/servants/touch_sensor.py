"""`TouchSensor` over touch sensors: one port serves all of them."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any

from robocomp_dsl.hardware.servants.servant import Servant


class TouchSensorServant(Servant):
    """All sensors of the port; removed ones are omitted."""

    def getValues(self) -> dict[str, Any]:
        """The values by sensor name."""
        return {
            name: self.types.SensorState(name=name, value=self.device(name).value())
            for name in self.ids
            if name in self._devices
        }
