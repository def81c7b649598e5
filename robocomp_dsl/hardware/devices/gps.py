"""A satellite receiver: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.description.scene import Triple
from robocomp_dsl.hardware.kinematics.geodesy import GeoPoint


class GpsDevice(Protocol):
    """A driver."""

    def place(self) -> GeoPoint:
        """Where it is on the globe."""

    def position(self) -> Triple:
        """Where it is against the last reset: x to the east, y up, z to the north, in mm."""

    def reset(self) -> None:
        """The present position becomes the origin."""
