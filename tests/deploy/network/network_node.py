"""Ports of a program in this process that has the certificate of a component."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.presence.network_settings import NETWORK_VARIABLE


class NetworkNode:
    """A program that says it is the component `name`."""

    def __init__(self, name: str, domain: str) -> None:
        self.name = name
        self.execution = CallbackGroup(4)
        self.statistics = Statistics()
        context = ComponentContext(name, domain, self.execution, self.statistics)
        self.ports: ComponentPorts = open_ports("zenoh", context)

    @property
    def session(self) -> Any:
        return self.ports.presence.opened.session  # type: ignore[attr-defined]

    def serve(
        self, interface: Interface, port: str, handlers: Mapping[str, Callable[..., Any]]
    ) -> None:
        every = {o.name: handlers.get(o.name, lambda *_: None) for o in interface.operations}
        self.ports.serve(Endpoint(interface, self.name, port), every, self.execution)

    def operations(self, interface: Interface, peer: str) -> dict[str, Callable[..., Any]]:
        """The operations of the port `component.port`."""
        at = Endpoint(interface, self.name, peer.rpartition(".")[2], (peer,))
        channel = self.ports.proxy(at)
        channel.timeout = 5.0
        return {o.name: channel.bind(o) for o in interface.operations}

    def publisher(self, interface: Interface, port: str, qos: Qos | None = None) -> Any:
        """The only operation of a published port."""
        channel = self.ports.advertise(Endpoint(interface, self.name, port, qos=qos or Qos()))
        return channel.bind(interface.operations[0])

    def subscribe(
        self, interface: Interface, port: str, *peers: str, qos: Qos | None = None
    ) -> list[Any]:
        """The messages that arrive at a port."""
        received: list[Any] = []
        at = Endpoint(interface, self.name, port, peers, qos or Qos())
        operation = interface.operations[0].name
        self.ports.subscribe(at, {operation: received.append}, self.execution)
        return received


@contextmanager
def open_node(
    settings: Path, name: str, domain: str, monkeypatch: pytest.MonkeyPatch
) -> Iterator[NetworkNode]:
    """A program with the certificate that `settings` name."""
    with monkeypatch.context() as patch:
        patch.setenv(NETWORK_VARIABLE, str(settings))
        node = NetworkNode(name, domain)
    try:
        yield node
    finally:
        node.ports.close()
