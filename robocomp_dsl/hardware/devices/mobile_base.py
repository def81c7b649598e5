"""A base that drives on the floor, whatever moves it: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.hardware.devices.errors import CommandRefused, require_within
from robocomp_dsl.hardware.kinematics.planar import Pose


@dataclass(frozen=True, slots=True)
class BaseLimits:
    """How fast a base may go (mm/s, rad/s), and whether it can go `sideways`."""

    max_adv: float = 1000.0
    max_rot: float = 2.0
    sideways: bool = False


@dataclass(frozen=True, slots=True)
class MobileBaseState:
    """What the base knows of itself at `time` in s.

    `odometry` begins at 0 and drifts, `corrected` has the drift removed; `side`, `adv` (mm/s) and
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
    """A driver. Every method raises `CommandRefused` for numbers that it cannot take."""

    @property
    def limits(self) -> BaseLimits:
        """How fast it may go."""

    def state(self) -> MobileBaseState:
        """The latest state."""

    def set_speed(self, side: float, adv: float, rot: float) -> None:
        """Drive sideways and ahead (mm/s) while turning (rad/s), until the next command."""

    def stop(self) -> None:
        """Stop as fast as the base can."""

    def set_odometry(self, pose: Pose) -> None:
        """The odometry goes on from `pose`."""

    def correct(self, pose: Pose) -> None:
        """The corrected pose goes on from `pose`; the odometry is left alone."""


def check_speed(limits: BaseLimits, side: float, adv: float, rot: float) -> None:
    """Pass when the base may drive so; else raise `CommandRefused`."""
    require_within("adv", adv, limits.max_adv, "mm/s")
    require_within("rot", rot, limits.max_rot, "rad/s")
    require_within("advx", side, limits.max_adv, "mm/s")
    if side and not limits.sideways:
        raise CommandRefused("this base cannot move sideways")
