"""Serves devices as interfaces: each operation is one call of a servant under the lock.

In: the ports of a component, the ids of their devices, and the devices, simulated or real.
Out: for every port an object with the operations of its interface as methods.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from robocomp_dsl.hardware.devices.errors import DeviceGone, HardwareError
from robocomp_dsl.hardware.servants.fair_lock import FairLock
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.runtime import ServedPort

Lock = AbstractContextManager[Any]


class DevicePort:
    """One port, with an attribute for each operation, created at its first call."""

    def __init__(self, servant: Servant, lock: Lock) -> None:
        self._servant = servant
        self._lock = lock
        self._reader = lock.reader if isinstance(lock, FairLock) else lock

    def latest(self, operation: str) -> list[Any]:
        """The result of `operation` as the only item; empty if the device has been removed."""
        try:
            with self._reader:
                return [getattr(self._servant, operation)()]
        except DeviceGone:
            return []

    def poll(self) -> list[tuple[Any, ...]]:
        """The messages to publish since the last call, each as the inputs of the topic."""
        messages = self.latest("poll")
        return messages[0] if messages else []

    def __getattr__(self, operation: str) -> Callable[..., Any]:
        method = getattr(self._servant, operation)
        to_idl_error, lock = self._servant.to_idl_error, self._lock

        def call(*arguments: Any) -> Any:
            try:
                with lock:
                    return method(*arguments)
            except HardwareError as error:
                raise to_idl_error(operation, error) from None

        self.__dict__[operation] = call
        return call


def serve(
    servants: Mapping[str, type[Servant]],
    ports: Iterable[ServedPort],
    chosen: Mapping[str, Sequence[str]],
    devices: Mapping[str, Any],
    lock: Lock,
    on_deployment_clock: Callable[[], bool] = bool,
) -> dict[str, DevicePort]:
    """The ports by name; `servants` maps each interface to its servant class.

    `chosen` lists the ids of the devices of each port; `lock` guards all devices.
    `on_deployment_clock` returns whether results must not depend on how long a call takes.
    """
    served = {}
    for port in ports:
        servant = servants[port.interface.name](
            port.interface, port.name, tuple(chosen[port.name]), devices
        )
        servant.on_deployment_clock = on_deployment_clock
        served[port.name] = DevicePort(servant, lock if servant.NEEDS_LOCK else nullcontext())
    return served
