"""What a device may be and do, as Protocols, and how devices are made."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.plumbing.description import DeviceSpec


class ActionFailed(HardwareError):
    """A calibration, a parking or an attachment that did not come to its end."""


class Device(Protocol):
    """Whatever is opened and closed; the factory opens it."""

    def close(self) -> None:
        """Give everything back. Called once, also after failures."""


class Stacked(Device, Protocol):
    """A device that stands on others: a wrapper, a calibrator, a controller."""

    def attach(self, devices: Mapping[str, Any]) -> None:
        """Stand on `devices`, by name, in order. Raises `HardwareError`."""

    def detach(self) -> None:
        """Let go of them."""


class Calibrating(Stacked, Protocol):
    """A stacked device that leads another to its zero and to its resting place.

    Both block, end soon when `stop` is set, and raise `HardwareError` when they fail.
    """

    def calibrate(self, target: str, stop: threading.Event) -> None:
        """Let the device `target` find its zero."""

    def park(self, target: str, stop: threading.Event) -> None:
        """Bring the device `target` to where it may be switched off."""


@dataclass(frozen=True, slots=True)
class Kind:
    """How a device of this kind is made, and which actions it knows.

    `open` may raise `HardwareError`. `most` is on how many devices it may stand: 0 for a driver.
    """

    open: Callable[[DeviceSpec], Any]
    most: int = 0
    calibrates: bool = False
