"""Hardware faults: detected in each step, latched until force-idle clears them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.control.joints import Bools, Floats, Ints
from robocomp_dsl.hardware.control.motors import Motors

Codes = NDArray[np.int32]


class FaultCode(IntEnum):
    """What a joint's fault is; the number is its code. `SILENCE` alone leaves the motor on."""

    NONE = 0
    OVERCURRENT = 1
    OVERTEMPERATURE = 2
    ENCODER = 3
    TRACKING = 4
    CALIBRATION = 5
    EXTERNAL = 6
    REFERENCE_TIMEOUT = 7
    SENSOR = 8


@dataclass(frozen=True, slots=True)
class FaultReport:
    """Message of a joint's last fault."""

    code: FaultCode
    message: str


_NONE = FaultReport(FaultCode.NONE, "")


class Faults:
    """The last fault of each joint; available also after it is cleared.

    `now` (n,) are the codes of uncleared faults.
    """

    def __init__(self, size: int) -> None:
        self.last = [_NONE] * size
        self.now: Codes = np.zeros(size, np.int32)

    def raise_(self, joints: Ints, code: FaultCode, message: str) -> None:
        """Record a fault of `joints`."""
        for joint in joints.tolist():
            self.last[joint] = FaultReport(code, message)
        self.now[joints] = code

    def clear(self, joints: Ints) -> None:
        """A mode change has cleared the faults of `joints`."""
        self.now[joints] = FaultCode.NONE


def overloaded(motors: Motors, current: Floats) -> Bools:
    """Motors (n,) at their maximum current."""
    over: Bools = np.abs(current) >= motors.max_current
    return over


def too_hot(motors: Motors) -> Bools:
    """Motors (n,) above their temperature limit."""
    hot: Bools = motors.temperature > motors.temperature_limit
    return hot
