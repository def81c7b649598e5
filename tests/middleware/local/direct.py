"""Transports of `local` that are connected by hand, without a presence."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import OperationCounts, Statistics
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.middleware.local.transport import LocalTransport
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.middleware.probe_types import PROBE

FRAMES = rt.Interface(
    "Test::Frames",
    rt.Operation("taken", rt.Pattern.PUBLISH, inputs={"number": rt.Int, "pixels": rt.UInt8Array}),
)
TIMEOUT_S = 60.0
NO_QOS = Qos()


class Side:
    """One component; `failures` are the reasons for which it would have ended."""

    def __init__(self, folder: Path, name: str) -> None:
        self.name = name
        self.group = CallbackGroup()
        self.statistics = Statistics()
        self.failures: list[str] = []
        context = TransportContext(name, "test", folder, self.failures.append)
        self.transport = LocalTransport(context)

    def at(self, interface: Interface, qos: Qos) -> Endpoint:
        return Endpoint(interface, self.name, interface.name.partition("::")[2], (), qos)

    def _incoming(
        self, interface: Interface, handlers: Mapping[str, Callable[..., Any]], qos: Qos
    ) -> IncomingPort:
        at = self.at(interface, qos)
        return IncomingPort(at, handlers, self.group, self.statistics, self.failures.append)

    def serve(
        self, handlers: Mapping[str, Callable[..., Any]], interface: Interface = PROBE
    ) -> PortRecord:
        port = self._incoming(interface, handlers, Qos())
        return self._record("server", port.at, self.transport.serve(port).address)

    def subscribe(
        self, handlers: Mapping[str, Callable[..., Any]], interface: Interface, qos: Qos = NO_QOS
    ) -> PortRecord:
        port = self._incoming(interface, handlers, qos)
        return self._record("subscriber", port.at, self.transport.subscribe(port).address)

    def _record(self, role: str, at: Endpoint, address: str) -> PortRecord:
        hash_ = at.interface.hash.hex()
        return PortRecord(role, at.interface.name, at.component, at.port, hash_, "local", address)

    def calls(
        self, server: PortRecord, interface: Interface = PROBE, timeout: float = TIMEOUT_S
    ) -> Calls:
        return Calls(self, server, interface, timeout)

    def publisher(self, interface: Interface, *subscribers: PortRecord, qos: Qos = NO_QOS) -> Topic:
        return Topic(self, interface, subscribers, qos)

    def count(self, operation: str, interface: Interface = PROBE) -> OperationCounts:
        return self.statistics.of(interface.name.partition("::")[2], operation)


class Calls:
    """Calls of one server."""

    def __init__(
        self, side: Side, server: PortRecord, interface: Interface, timeout: float
    ) -> None:
        self.client = side.transport.connect(side.at(interface, Qos()), server, timeout)
        self._bound = {
            operation.name: self.client.bind(operation, side.count(operation.name, interface))
            for operation in interface.operations
        }

    def __call__(self, operation: str, *arguments: Any) -> Any:
        encode, send = self._bound[operation]
        return send(encode(arguments))


class Topic:
    """A published port."""

    def __init__(
        self, side: Side, interface: Interface, subscribers: tuple[PortRecord, ...], qos: Qos
    ) -> None:
        self.publisher = side.transport.advertise(side.at(interface, qos))
        for subscriber in subscribers:
            self.publisher.attach(subscriber)
        self._bound = {
            operation.name: self.publisher.bind(operation, side.count(operation.name, interface))
            for operation in interface.operations
        }
        self._number = 0

    def __call__(self, operation: str, *arguments: Any) -> None:
        encode, send = self._bound[operation]
        self._number += 1
        send(encode(arguments), self._number.to_bytes(16, "little"))


def open_descriptors() -> int:
    """How many descriptors this process has."""
    return sum(1 for _ in Path("/proc/self/fd").iterdir())
