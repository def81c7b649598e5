"""A satellite receiver: the Protocol of its drivers."""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.hardware.geodesy import Place
from robocomp_dsl.hardware.scene import Triple


class GpsDevice(Protocol):
    """A driver."""

    def place(self) -> Place:
        """Where it is on the globe."""

    def position(self) -> Triple:
        """Where it is against the last reset: x to the east, y up, z to the north, in mm."""

    def reset(self) -> None:
        """The present position becomes the origin."""
