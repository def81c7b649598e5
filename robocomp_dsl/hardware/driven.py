"""Real devices behind the ports of a component: the twin of a simulation.

In: a driver that keeps to the Protocol of its device, and can be opened and closed. Out: `devices`
to be served, under `turns`. What is not there, or has failed, is opened again.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import Any, NoReturn, Protocol, cast

from robocomp_dsl.hardware.errors import CommandRefused, HardwareError, NotWritten
from robocomp_dsl.hardware.motor_bus import DrivenBoard, MotorBus
from robocomp_dsl.hardware.plumbing.boards import BoardPart
from robocomp_dsl.hardware.plumbing.description import DeviceSpec
from robocomp_dsl.hardware.plumbing.host import Hosted
from robocomp_dsl.hardware.serving import Port, serve
from robocomp_dsl.runtime import ServedPort

FAILURES = (HardwareError, OSError)
"""What a driver raises when its device does not do as it should."""


class Driver(Protocol):
    """What every driver has beside the methods of its device."""

    def open(self) -> None:
        """Connect to the device. Raises `HardwareError` or `OSError` while it is not there."""

    def close(self) -> None:
        """Leave the device at rest, and let go of it."""


class Hardware:
    """The device of one driver, known by `ids`; `motors`: it is a bus of motors."""

    def __init__(self, driver: Driver, ids: Sequence[str], *, motors: bool = False) -> None:
        self.driver = driver
        self.turns = threading.RLock()
        self.devices = _Devices(self, tuple(ids))
        self.device: Any = None
        self.why = "it has not been opened yet"
        self._motors, self._reference_timeout = motors, 0.0

    def serve(self, ports: Iterable[ServedPort], chosen: dict[str, list[str]]) -> dict[str, Port]:
        """The ports of a component, answered by the device."""
        return serve(ports, chosen, self.devices, self.turns)

    def open(self) -> None:
        """Open the device unless it is. Raises `HardwareError`."""
        if self.device is not None:
            return
        try:
            self.driver.open()
            if self._motors:
                made = DrivenBoard(cast(MotorBus, self.driver), self.turns)
                made.settings.set_reference_timeout(self._reference_timeout)
                made.start()
                self.device = made
            else:
                self.device = _Watched(self)
        except NotWritten:
            raise
        except FAILURES as error:
            self.let_go(error)
            raise HardwareError(self.why) from None

    def set_reference_timeout(self, seconds: float) -> None:
        """How long who pushes motors may be silent [s]; 0: for ever."""
        self._reference_timeout = seconds
        if isinstance(self.device, DrivenBoard):
            with self.turns:
                self.device.settings.set_reference_timeout(seconds)

    def close(self) -> None:
        """Leave the device at rest."""
        if isinstance(self.device, DrivenBoard):
            self.device.stop()
        self.device = None
        self.driver.close()

    @contextmanager
    def working(self) -> Iterator[None]:
        """Work with the device, which is open then; a failure closes it. Raises `HardwareError`."""
        self.open()
        try:
            if isinstance(self.device, DrivenBoard):
                self.device.judge()
            yield
        except FAILURES as error:
            self.let_go(error)
            raise HardwareError(self.why) from None

    def let_go(self, error: Exception) -> None:
        """Close the device because of `error`; the next who works with it opens it again."""
        self.why = str(error) or type(error).__name__
        with suppress(*FAILURES):
            self.close()


class Plugged(Hosted):
    """The devices of a deployment on real motors, which are known by the names `parts`."""

    def __init__(
        self, hardware: Hardware, parts: Sequence[str], environment: Mapping[str, str]
    ) -> None:
        def boards() -> dict[str, BoardPart]:
            device = hardware.device
            if not isinstance(device, DrivenBoard):
                return {}
            part = BoardPart(device.board, device.board.spec.names)
            return dict.fromkeys(parts, part)

        super().__init__(environment, boards, hardware.turns, _no_chain)


def _no_chain(spec: DeviceSpec, _: tuple[str, ...]) -> NoReturn:
    raise CommandRefused(f"device `{spec.name}`: these motors know no bodies, so no chain to a tip")


class _Watched:
    """The driver as others see it: what its device does not do closes it."""

    def __init__(self, owner: Hardware) -> None:
        self._owner = owner

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._owner.driver, name)
        if not callable(found):
            return found

        def call(*given: Any) -> Any:
            try:
                return found(*given)
            except (CommandRefused, NotWritten):
                raise
            except FAILURES as error:
                self._owner.let_go(error)
                raise HardwareError(self._owner.why) from None

        return call


class _Devices(Mapping[str, Any]):
    """The device under each of its ids. Raises `HardwareError` while it is not there."""

    def __init__(self, owner: Hardware, ids: tuple[str, ...]) -> None:
        self._owner, self._ids = owner, ids

    def __getitem__(self, id: str) -> Any:
        if id not in self._ids:
            raise KeyError(id)
        if self._owner.device is None:
            raise HardwareError(f"`{id}` is not there: {self._owner.why}")
        return self._owner.device

    def __iter__(self) -> Iterator[str]:
        return iter(self._ids)

    def __len__(self) -> int:
        return len(self._ids)
