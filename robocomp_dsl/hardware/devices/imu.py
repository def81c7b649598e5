"""An inertial measurement unit: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.hardware.description.scene import Triple


@dataclass(frozen=True, slots=True)
class Inertial:
    """One measurement at `time` (s), in the frame of the unit: x right, y up, z ahead.

    `acceleration` (m/s²) is that of an accelerometer: 9.81 upwards at rest.
    `turning` is in rad/s, `field` a direction of unit length. `orientation` is rx, ry, rz
    relative to the reference that `reset` sets.
    """

    time: float
    acceleration: Triple
    angular_velocity: Triple
    field: Triple
    orientation: Triple
    temperature: float


class ImuDevice(Protocol):
    """A driver of an inertial unit."""

    def measure(self) -> Inertial:
        """The latest measurement."""

    def reset(self) -> None:
        """Make the current orientation the reference."""
