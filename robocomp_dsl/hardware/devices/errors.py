"""What can go wrong with a device, as one tree.

HardwareError
├── CommandRefused      the command was refused; the state of the device is unchanged
├── DeviceGone          the device was removed from the world
├── DriverMethodMissing a method of a driver that is still generated
├── NoRendering         pictures cannot be rendered on this machine
├── FrameError          a frame that is missing, exists already, or cannot be moved
└── SceneError          the description of the world cannot be simulated
    └── Diverged        the physics has diverged; the simulation must be reset
"""

from __future__ import annotations

import math


class HardwareError(Exception):
    """Base of the failures of devices; the message is for the user."""


class CommandRefused(HardwareError):
    """An invalid command, or one beyond a limit; nothing has changed."""


class DeviceGone(HardwareError):
    """The device has been removed from the world."""


class DriverMethodMissing(HardwareError):
    """A method of a driver that is still as `rcgen hardware` generated it."""

    def __init__(self, method: str) -> None:
        super().__init__(f"`{method}` of driver.py is not implemented yet")


class NoRendering(HardwareError):
    """Pictures cannot be rendered on this machine: OpenGL, EGL or OSMesa is missing."""


class FrameError(HardwareError):
    """A frame that is missing, exists already, or cannot be moved."""


class SceneError(HardwareError):
    """The description of the world cannot be simulated."""


class Diverged(SceneError):
    """The physics has left the range of finite numbers."""


def require_finite(**values: float) -> None:
    """Pass when all `values` are finite numbers; else raise `CommandRefused` naming the first."""
    for name, value in values.items():
        if not math.isfinite(value):
            raise CommandRefused(f"`{name}` is {value}, it must be a finite number")


def require_within(name: str, value: float, limit: float, unit: str) -> None:
    """Pass when |`value`| ≤ `limit`; else raise `CommandRefused` with both."""
    require_finite(**{name: value})
    if abs(value) > limit:
        raise CommandRefused(f"`{name}` is {value:g} {unit}, the limit is ±{limit:g} {unit}")
