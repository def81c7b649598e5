"""Components of a test, defined in a few lines; all end with the test."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from tests.middleware.probe_types import NEWS, PROBE, NewsProxy, ProbeProxy

DEADLINE = 60.0
NO_QOS = Qos()


class Node:
    """One component."""

    def __init__(self, network: Network, name: str, threads: int = 1) -> None:
        self.name = name
        self.middlewares = (network.kind,)
        self.execution = CallbackGroup(threads)
        self.statistics = Statistics()
        host = ComponentContext(name, network.domain, self.execution, self.statistics)
        self.ports: ComponentPorts = open_ports(network.kind, host)

    def at(
        self, interface: Interface, port: str, peers: tuple[str, ...] = (), qos: Qos = NO_QOS
    ) -> Endpoint:
        """A port on the middleware under test."""
        return Endpoint(interface, self.name, port, peers, qos, self.middlewares)

    def serve(
        self,
        handlers: Mapping[str, Callable[..., Any]],
        interface: Interface = PROBE,
        port: str = "Probe",
    ) -> None:
        every = {o.name: handlers.get(o.name, lambda *_: None) for o in interface.operations}
        self.ports.serve(self.at(interface, port), every, self.execution)

    def probe(self, *peers: str) -> ProbeProxy:
        return ProbeProxy(self.ports.proxy(self.at(PROBE, "Probe", peers)))

    def news(self) -> NewsProxy:
        return NewsProxy(self.ports.advertise(self.at(NEWS, "News")))

    def subscribe(
        self, handler: Callable[[str, int], None], *peers: str, qos: Qos | None = None
    ) -> None:
        at = self.at(NEWS, "News", peers, qos or Qos())
        self.ports.subscribe(at, {"announced": handler}, self.execution)

    def count(self, operation: str, port: str = "Probe") -> Any:
        return self.statistics.of(port, operation)


class Network:
    """A domain of its own."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.domain = f"test-{uuid.uuid4().hex[:12]}"
        self.nodes: list[Node] = []

    def node(self, name: str, threads: int = 1) -> Node:
        node = Node(self, name, threads)
        self.nodes.append(node)
        return node

    def close(self) -> None:
        for node in self.nodes:
            node.ports.close()
