"""A satellite receiver: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.description.scene import Triple
from robocomp_dsl.hardware.kinematics.geodesy import GeoPoint


class GpsDevice(Protocol):
    """A driver of a receiver."""

    def place(self) -> GeoPoint:
        """The position on the globe."""

    def position(self) -> Triple:
        """The position relative to the last reset: x east, y up, z north, in mm."""

    def reset(self) -> None:
        """Make the current position the origin."""
