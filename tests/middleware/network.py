"""Components of a test, defined in a few lines; all end with the test."""

from __future__ import annotations

import re
import uuid
from collections.abc import Callable, Mapping
from typing import Any

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.registry import capabilities_of
from tests.middleware.probe_types import NEWS, PROBE, NewsProxy, ProbeProxy

DEADLINE = 60.0


class Node:
    """One component, all of whose ports are on the middleware of its network."""

    def __init__(self, network: Network, name: str, threads: int = 1) -> None:
        self.name = name
        self.middleware = network.middleware
        self.execution = CallbackGroup(threads)
        self.statistics = Statistics()
        self.failures: list[str] = []
        context = ComponentContext(
            name, network.domain, self.execution, self.statistics, fail=self.failures.append
        )
        self.ports: ComponentPorts = open_ports(network.middleware, context)

    def at(self, interface: Interface, port: str, *peers: str, qos: Qos | None = None) -> Endpoint:
        """A port of this component."""
        return Endpoint(interface, self.name, port, peers, qos or Qos(), (self.middleware,))

    def serve(
        self,
        handlers: Mapping[str, Callable[..., Any]],
        interface: Interface = PROBE,
        port: str = "Probe",
    ) -> None:
        every = {o.name: handlers.get(o.name, lambda *_: None) for o in interface.operations}
        self.ports.serve(self.at(interface, port), every, self.execution)

    def probe(self, *peers: str) -> ProbeProxy:
        return ProbeProxy(self.ports.proxy(self.at(PROBE, "Probe", *peers)))

    def news(self, port: str = "News", qos: Qos | None = None) -> NewsProxy:
        return NewsProxy(self.ports.advertise(self.at(NEWS, port, qos=qos)))

    def subscribe(
        self,
        handler: Callable[[str, int], None],
        *peers: str,
        qos: Qos | None = None,
        port: str = "News",
        group: CallbackGroup | None = None,
    ) -> None:
        at = self.at(NEWS, port, *peers, qos=qos)
        self.ports.subscribe(at, {"announced": handler}, group or self.execution)

    def count(self, operation: str, port: str = "Probe") -> Any:
        return self.statistics.of(port, operation)


class Network:
    """A domain of its own, on one middleware."""

    def __init__(self, middleware: str, domain: str = "") -> None:
        self.middleware = middleware
        self.capabilities = capabilities_of(middleware)
        self.domain = domain or f"test-{uuid.uuid4().hex[:12]}"
        self.nodes: list[Node] = []

    def node(self, name: str, threads: int = 1) -> Node:
        """A new component; skips the test if the middleware does not allow the name."""
        names = self.capabilities.valid_names
        if names and not re.fullmatch(names, name):
            pytest.skip(f"{self.middleware} allows no component `{name}` (valid_names)")
        node = Node(self, name, threads)
        self.nodes.append(node)
        return node

    def close(self) -> None:
        """End all components."""
        nodes, self.nodes = self.nodes, []
        for node in nodes:
            node.ports.close()
