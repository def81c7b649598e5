"""A battery: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True)
class Charge:
    """`left`: charge from 0 to 1; `voltage` in V; consumed `power` in W; `remaining` in s."""

    left: float
    voltage: float
    power: float
    remaining: float
    charging: bool = False


class BatteryDevice(Protocol):
    """A driver of a battery."""

    def charge(self) -> Charge:
        """The current state."""
