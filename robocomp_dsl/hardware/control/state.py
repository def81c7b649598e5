"""State of a control board, with its time."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.hardware.control.joints import Floats
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.control.protection.faults import Codes


@dataclass(frozen=True, eq=False, slots=True)
class BoardState:
    """All arrays (n,), in the order of the board: rad, rad/s, rad/s², N m, counts, A, percent.

    `faults` are codes, 0 for none.
    """

    time: float
    position: Floats
    velocity: Floats
    acceleration: Floats
    torque: Floats
    reference: Floats
    motor_counts: Floats
    motor_speed: Floats
    current: Floats
    duty: Floats
    temperature: Floats
    modes: tuple[Mode, ...]
    interactions: tuple[Interaction, ...]
    faults: Codes
