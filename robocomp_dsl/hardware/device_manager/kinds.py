"""Protocols of managed devices, and the kinds that create them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from robocomp_dsl.hardware.device_manager.description import DeviceSpec
from robocomp_dsl.hardware.devices.errors import HardwareError


class ActionFailed(HardwareError):
    """A calibration, parking or attachment that failed."""


class ManagedDevice(Protocol):
    """A device that is opened by its factory, and closed."""

    def close(self) -> None:
        """Release all resources. Called once, also after failures."""


class Attachable(ManagedDevice, Protocol):
    """A device that is attached to others: a wrapper, a calibrator, a controller."""

    def attach(self, devices: Mapping[str, Any]) -> None:
        """Attach to `devices`, by name, in order. Raises `HardwareError`."""

    def detach(self) -> None:
        """Detach from all devices."""


class CalibrationDevice(Attachable, Protocol):
    """An attachable device that calibrates and parks another.

    Both methods block, return soon after `stop` is set, and raise `HardwareError` on failure.
    """

    def calibrate(self, target: str, stop: threading.Event) -> None:
        """Find the zero position of the device `target`."""

    def park(self, target: str, stop: threading.Event) -> None:
        """Move the device `target` to its parking position."""


@dataclass(frozen=True, slots=True)
class DeviceKind:
    """How to create a device of this kind, and which actions it supports.

    `open` may raise `HardwareError`. `max_attached` is the number of devices it may be attached to:
    0 for a driver.
    """

    open: Callable[[DeviceSpec], Any]
    max_attached: int = 0
    calibrates: bool = False
