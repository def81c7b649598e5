"""A battery: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True)
class Charge:
    """`left` of 1; `voltage` in V; `power` in W that is drawn; `remaining` in s at that power."""

    left: float
    voltage: float
    power: float
    remaining: float
    charging: bool = False


class BatteryDevice(Protocol):
    """A driver."""

    def charge(self) -> Charge:
        """The state now."""
