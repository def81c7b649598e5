"""`BatteryStatus` over a battery."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any

from robocomp_dsl.hardware.servants.servant import Servant


class BatteryServant(Servant):
    """One battery."""

    def getBatteryState(self) -> Any:
        """The current state."""
        it = self.device().charge()
        states = self.types.BatteryStates
        full = states.Charged if it.left >= 1 else states.Charging
        return self.types.TBattery(
            percentage=100 * it.left,
            state=full if it.charging else states.Disconnected,
            voltage=it.voltage,
            current=it.power / it.voltage if it.voltage else 0.0,
            timeToGo=it.remaining,
            power=it.power,
            consumptionPerHour=it.power,
        )
