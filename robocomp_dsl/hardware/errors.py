"""What can go wrong with a device, as one tree.

HardwareError
├── CommandRefused      the command was not carried out; the device does what it did before
├── DeviceGone          the device was taken out of the world
├── NotWritten          a method of a driver that nobody has filled in yet
├── FrameError          a frame that is not there, is there already, or cannot go there
└── SceneError          the description of the world cannot be simulated
    └── Diverged        the simulation has become meaningless and must be started again
"""

from __future__ import annotations

import math


class HardwareError(Exception):
    """Base of the failures of devices; the message is for the user."""


class CommandRefused(HardwareError):
    """A command that makes no sense or is beyond a limit; nothing has changed."""


class DeviceGone(HardwareError):
    """The device was there and has been taken out of the world."""


class NotWritten(HardwareError):
    """A method of a driver that is still as `rcgen hardware` wrote it."""

    def __init__(self, method: str) -> None:
        super().__init__(f"`{method}` of driver.py is not written yet")


class FrameError(HardwareError):
    """A frame that does not exist, exists already, or cannot go where it shall."""


class SceneError(HardwareError):
    """The world cannot be simulated as it is described."""


class Diverged(SceneError):
    """The physics has left the range of finite numbers."""


def finite(**values: float) -> None:
    """Pass when all `values` are finite numbers; else raise `CommandRefused` naming the first."""
    for name, value in values.items():
        if not math.isfinite(value):
            raise CommandRefused(f"`{name}` is {value}, it must be a finite number")


def within(name: str, value: float, limit: float, unit: str) -> None:
    """Pass when |`value`| ≤ `limit`; else raise `CommandRefused` with both."""
    finite(**{name: value})
    if abs(value) > limit:
        raise CommandRefused(f"`{name}` is {value:g} {unit}, the limit is ±{limit:g} {unit}")
