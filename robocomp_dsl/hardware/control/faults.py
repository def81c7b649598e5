"""Hardware faults: found each step, latched until force-idle clears them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from robocomp_dsl.hardware.control.joints import Bools, Floats, Ints
from robocomp_dsl.hardware.control.motors import Motors


class Fault(IntEnum):
    """What a joint's fault is; the number is its code."""

    NONE = 0
    OVERCURRENT = 1
    OVERTEMPERATURE = 2
    ENCODER = 3
    TRACKING = 4
    CALIBRATION = 5
    EXTERNAL = 6


@dataclass(frozen=True, slots=True)
class FaultReport:
    """The last fault of a joint, in words."""

    code: Fault
    message: str


_NONE = FaultReport(Fault.NONE, "")


class Faults:
    """The last fault of each joint; kept after it is cleared, so that one can ask why."""

    def __init__(self, size: int) -> None:
        self.last = [_NONE] * size

    def raise_(self, joints: Ints, code: Fault, message: str) -> None:
        """Note a fault of `joints`."""
        for joint in joints.tolist():
            self.last[joint] = FaultReport(code, message)


def overloaded(motors: Motors, current: Floats) -> Bools:
    """Motors (n,) whose current has reached their largest one."""
    over: Bools = np.abs(current) >= motors.max_current
    return over


def too_hot(motors: Motors) -> Bools:
    """Motors (n,) above their temperature limit."""
    hot: Bools = motors.temperature > motors.temperature_limit
    return hot
