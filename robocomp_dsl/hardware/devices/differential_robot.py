"""A base with two driven wheels on one axis: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.hardware.devices.errors import require_within
from robocomp_dsl.hardware.kinematics.planar import Pose


@dataclass(frozen=True, slots=True)
class Mechanics:
    """Dimensions (mm) and limits of the base (mm/s, rad/s, mm/s²).

    `axis` is the distance of the wheels; `encoder_steps` per motor revolution, and `gear_ratio`
    motor revolutions per wheel revolution; 0 steps: an ideal encoder.
    """

    wheel_radius: float = 80.0
    axis: float = 340.0
    body_radius: float = 220.0
    body_height: float = 150.0
    mass_kg: float = 8.0
    encoder_steps: int = 512
    gear_ratio: int = 20
    max_adv: float = 800.0
    max_rot: float = 2.0
    max_acceleration: float = 1500.0


@dataclass(frozen=True, slots=True)
class BaseState:
    """State of the base at `time` (s since its start).

    `odometry` is from the wheels only and drifts; `corrected` is drift-free. `adv` and
    `rot` are measured, not commanded.
    """

    time: float
    odometry: Pose
    corrected: Pose
    adv: float
    rot: float
    moving: bool


class DifferentialRobotDevice(Protocol):
    """A driver of a base. Every method raises `CommandRefused` for invalid numbers."""

    @property
    def mechanics(self) -> Mechanics:
        """The dimensions and limits of the base."""

    def state(self) -> BaseState:
        """The latest state."""

    def set_speed(self, adv: float, rot: float) -> None:
        """Drive at `adv` mm/s while turning at `rot` rad/s, until the next command."""

    def stop(self) -> None:
        """Stop as fast as possible."""

    def set_odometry(self, pose: Pose) -> None:
        """Set the odometry to `pose`."""

    def correct(self, pose: Pose) -> None:
        """Set the corrected pose to `pose`; the odometry is unchanged."""


def check_speed(mechanics: Mechanics, adv: float, rot: float) -> None:
    """Raise `CommandRefused` unless the base permits these speeds."""
    require_within("adv", adv, mechanics.max_adv, "mm/s")
    require_within("rot", rot, mechanics.max_rot, "rad/s")


def wheel_speeds(mechanics: Mechanics, adv: float, rot: float) -> tuple[float, float]:
    """Speeds of the left and the right wheel at the floor in mm/s."""
    turn = rot * mechanics.axis / 2
    return adv + turn, adv - turn
