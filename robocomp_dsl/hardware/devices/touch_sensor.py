"""A touch sensor with one value: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol


class TouchSensorDevice(Protocol):
    """A driver of a touch sensor."""

    def value(self) -> float:
        """The contact force [N]; 1 or 0 for a bumper."""
