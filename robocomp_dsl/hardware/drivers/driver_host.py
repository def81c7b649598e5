"""Hosts the driver of a real device behind the ports of a component.

In: a driver that implements the Protocol of its device, and can be opened and closed. Out:
`devices` to serve, guarded by `lock`. A missing or failed device is reopened.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import Any, NoReturn, Protocol, cast

from robocomp_dsl.hardware.device_manager.boards import BoardPart
from robocomp_dsl.hardware.device_manager.description import DeviceSpec
from robocomp_dsl.hardware.device_manager.host import DeviceHost
from robocomp_dsl.hardware.devices.errors import CommandRefused, DriverMethodMissing, HardwareError
from robocomp_dsl.hardware.drivers.motor_bus import HardwareBoard, MotorBus
from robocomp_dsl.hardware.servants.registry import SERVANTS
from robocomp_dsl.hardware.servants.serving import DevicePort, serve
from robocomp_dsl.runtime import ServedPort

FAILURES = (HardwareError, OSError)
"""Exceptions of a driver whose device fails."""


class Driver(Protocol):
    """The methods of every driver besides those of its device."""

    def open(self) -> None:
        """Connect to the device. Raises `HardwareError` or `OSError` while it is missing."""

    def close(self) -> None:
        """Leave the device at rest, and disconnect."""


class DriverHost:
    """The device of one driver, with the ids `ids`; `motors`: it is a bus of motors."""

    def __init__(self, driver: Driver, ids: Sequence[str], *, motors: bool = False) -> None:
        self.driver = driver
        self.lock = threading.RLock()
        self.devices = _Devices(self, tuple(ids))
        self.device: Any = None
        self.failure_reason = "it has not been opened yet"
        self._motors, self._reference_timeout = motors, 0.0

    def serve(
        self, ports: Iterable[ServedPort], chosen: dict[str, list[str]]
    ) -> dict[str, DevicePort]:
        """The ports of a component, served by the device."""
        return serve(SERVANTS, ports, chosen, self.devices, self.lock)

    def open(self) -> None:
        """Open the device if it is closed. Raises `HardwareError`."""
        if self.device is not None:
            return
        try:
            self.driver.open()
            if self._motors:
                board = HardwareBoard(cast(MotorBus, self.driver), self.lock)
                board.settings.set_reference_timeout(self._reference_timeout)
                board.start()
                self.device = board
            else:
                self.device = _DriverProxy(self)
        except DriverMethodMissing:
            raise
        except FAILURES as error:
            self.close_after_failure(error)
            raise HardwareError(self.failure_reason) from None

    def set_reference_timeout(self, seconds: float) -> None:
        """Time-out of streamed motor references [s]; 0: none."""
        self._reference_timeout = seconds
        if isinstance(self.device, HardwareBoard):
            with self.lock:
                self.device.settings.set_reference_timeout(seconds)

    def close(self) -> None:
        """Leave the device at rest."""
        if isinstance(self.device, HardwareBoard):
            self.device.stop()
        self.device = None
        self.driver.close()

    @contextmanager
    def working(self) -> Iterator[None]:
        """A context in which the device is open; a failure closes it. Raises `HardwareError`."""
        self.open()
        try:
            if isinstance(self.device, HardwareBoard):
                self.device.raise_if_failed()
            yield
        except FAILURES as error:
            self.close_after_failure(error)
            raise HardwareError(self.failure_reason) from None

    def close_after_failure(self, error: Exception) -> None:
        """Close the device because of `error`; the next use opens it again."""
        self.failure_reason = str(error) or type(error).__name__
        with suppress(*FAILURES):
            self.close()


class DriverDeviceHost(DeviceHost):
    """The devices of a deployment on real motors; `parts` are their names."""

    def __init__(
        self, hardware: DriverHost, parts: Sequence[str], environment: Mapping[str, str]
    ) -> None:
        def boards() -> dict[str, BoardPart]:
            device = hardware.device
            if not isinstance(device, HardwareBoard):
                return {}
            part = BoardPart(device.board, device.board.spec.names)
            return dict.fromkeys(parts, part)

        super().__init__(environment, boards, hardware.lock, _no_chain)


def _no_chain(spec: DeviceSpec, _: tuple[str, ...]) -> NoReturn:
    raise CommandRefused(
        f"device `{spec.name}`: real motors have no model of the bodies, so no chain to a tip"
    )


class _DriverProxy:
    """The driver as used by servants: a failure closes the device."""

    def __init__(self, owner: DriverHost) -> None:
        self._owner = owner

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._owner.driver, name)
        if not callable(found):
            return found

        def call(*arguments: Any) -> Any:
            try:
                return found(*arguments)
            except (CommandRefused, DriverMethodMissing):
                raise
            except FAILURES as error:
                self._owner.close_after_failure(error)
                raise HardwareError(self._owner.failure_reason) from None

        return call


class _Devices(Mapping[str, Any]):
    """The device by each of its ids. Raises `HardwareError` while it is missing."""

    def __init__(self, owner: DriverHost, ids: tuple[str, ...]) -> None:
        self._owner, self._ids = owner, ids

    def __getitem__(self, id: str) -> Any:
        if id not in self._ids:
            raise KeyError(id)
        if self._owner.device is None:
            raise HardwareError(f"`{id}` is not there: {self._owner.failure_reason}")
        return self._owner.device

    def __iter__(self) -> Iterator[str]:
        return iter(self._ids)

    def __len__(self) -> int:
        return len(self._ids)
