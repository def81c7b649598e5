"""A base with two driven wheels on one axis: its data and the Protocol of its drivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from robocomp_dsl.hardware.devices.errors import require_within
from robocomp_dsl.hardware.kinematics.planar import Pose


@dataclass(frozen=True, slots=True)
class Mechanics:
    """How the base is built (mm) and how fast it may go (mm/s, rad/s, mm/s²).

    `axis` is the distance of the wheels; `encoder_steps` are counted per turn of the motor, which
    turns `gear_ratio` times as fast as the wheel; 0 steps: the encoder is ideal.
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
    """What the base knows of itself at `time` (s since its start).

    `odometry` comes from the wheels alone and drifts; `corrected` has the drift removed. `adv` and
    `rot` are measured, not commanded.
    """

    time: float
    odometry: Pose
    corrected: Pose
    adv: float
    rot: float
    moving: bool


class DifferentialRobotDevice(Protocol):
    """A driver. Every method raises `CommandRefused` for numbers that it cannot take."""

    @property
    def mechanics(self) -> Mechanics:
        """How the base is built."""

    def state(self) -> BaseState:
        """The latest state."""

    def set_speed(self, adv: float, rot: float) -> None:
        """Drive at `adv` mm/s while turning at `rot` rad/s, until the next command."""

    def stop(self) -> None:
        """Stop as fast as the base can."""

    def set_odometry(self, pose: Pose) -> None:
        """The odometry goes on from `pose`."""

    def correct(self, pose: Pose) -> None:
        """The corrected pose goes on from `pose`; the odometry is left alone."""


def check_speed(mechanics: Mechanics, adv: float, rot: float) -> None:
    """Pass when the base may drive so; else raise `CommandRefused`."""
    require_within("adv", adv, mechanics.max_adv, "mm/s")
    require_within("rot", rot, mechanics.max_rot, "rad/s")


def wheel_speeds(mechanics: Mechanics, adv: float, rot: float) -> tuple[float, float]:
    """Speeds of the left and the right wheel at the floor in mm/s."""
    turn = rot * mechanics.axis / 2
    return adv + turn, adv - turn
