"""A base that drives on the floor, with any drive: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.hardware.devices.errors import CommandRefused, require_within
from robocomp_dsl.hardware.kinematics.planar import Pose


@dataclass(frozen=True, slots=True)
class BaseLimits:
    """Speed limits of a base (mm/s, rad/s), and whether it can move `sideways`."""

    max_adv: float = 1000.0
    max_rot: float = 2.0
    sideways: bool = False


@dataclass(frozen=True, slots=True)
class MobileBaseState:
    """State of a base at `time` in s.

    `odometry` starts at 0 and drifts, `corrected` is drift-free; `side`, `adv` (mm/s) and
    `rot` (rad/s) are measured, in the frame of the base.
    """

    time: float
    odometry: Pose
    corrected: Pose
    side: float
    adv: float
    rot: float
    moving: bool


class MobileBaseDevice(Protocol):
    """A driver of a base. Every method raises `CommandRefused` for invalid numbers."""

    @property
    def limits(self) -> BaseLimits:
        """The speed limits."""

    def state(self) -> MobileBaseState:
        """The latest state."""

    def set_speed(self, side: float, adv: float, rot: float) -> None:
        """Drive sideways and ahead (mm/s) while turning (rad/s), until the next command."""

    def stop(self) -> None:
        """Stop as fast as possible."""

    def set_odometry(self, pose: Pose) -> None:
        """Set the odometry to `pose`."""

    def correct(self, pose: Pose) -> None:
        """Set the corrected pose to `pose`; the odometry is unchanged."""


def check_speed(limits: BaseLimits, side: float, adv: float, rot: float) -> None:
    """Raise `CommandRefused` unless the base permits these speeds."""
    require_within("adv", adv, limits.max_adv, "mm/s")
    require_within("rot", rot, limits.max_rot, "rad/s")
    require_within("advx", side, limits.max_adv, "mm/s")
    if side and not limits.sideways:
        raise CommandRefused("this base cannot move sideways")
