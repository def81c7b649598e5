"""Components of a test on one of the ROS 2 middlewares, in a ROS domain of their own."""

from __future__ import annotations

import itertools
import json
import os
import socket
import uuid
from collections.abc import Callable
from typing import Any

import zenoh

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.errors import Timeout
from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.support.waiting import wait_until

NO_MASTER = "http://127.0.0.1:9"
"""Nobody listens there: components of ROS 1 find each other without a master."""
_domain_ids = itertools.cycle(range(1, 100))


def next_domain_id() -> int:
    """A ROS domain; concurrent test processes start at different domains."""
    return (next(_domain_ids) + os.getpid() * 7) % 100


def open_router() -> tuple[zenoh.Session, str]:
    """A router on a free loopback port, as `rmw_zenohd`; and its address."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        address = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    config = zenoh.Config()
    for key, value in {
        "mode": "router",
        "listen/endpoints": [address],
        "scouting/multicast/enabled": False,
        "scouting/delay": 0,
    }.items():
        config.insert_json5(key, json.dumps(value))
    return zenoh.open(config), address


class RosComponent:
    """One component; `addresses` are the ROS names of its own ports."""

    def __init__(
        self, network: RosNetwork, name: str, addresses: dict[str, str], threads: int
    ) -> None:
        self._kind = network.kind
        self.name = name
        self.execution = CallbackGroup(threads)
        self.statistics = Statistics()
        self.failures: list[str] = []
        context = ComponentContext(
            name,
            network.domain,
            self.execution,
            self.statistics,
            fail=self.failures.append,
            addresses={(self._kind, port): at for port, at in addresses.items()},
            transport_settings=network.settings,
        )
        self.ports = open_ports(self._kind, context)

    def endpoint(
        self, interface: Interface, port: str, qos: Qos, peers: tuple[str, ...], role: str
    ) -> Endpoint:
        """A port; peers that start with `/` are ROS names of external programs."""
        external = tuple(
            PortRecord(role, interface.name, f"ros{i}", port, "", self._kind, peer)
            for i, peer in enumerate(peers)
            if peer.startswith("/")
        )
        own = tuple(peer for peer in peers if not peer.startswith("/"))
        return Endpoint(interface, self.name, port, own, qos, (self._kind,), external)

    def serve(
        self, interface: Interface, handlers: dict[str, Callable[..., Any]], port: str
    ) -> None:
        at = self.endpoint(interface, port, Qos(), (), "server")
        self.ports.serve(at, handlers, self.execution)

    def caller(
        self, interface: Interface, operation: str, port: str, *peers: str, timeout: float = 10.0
    ) -> Any:
        """A function that calls an operation."""
        channel = self.ports.proxy(self.endpoint(interface, port, Qos(), peers, "server"))
        channel.timeout = timeout
        return channel.bind(interface.operation(operation))

    def answered(
        self, interface: Interface, operation: str, port: str, *peers: str, request: Any
    ) -> Any:
        """The reply to a request.

        It is repeated: a DDS server on a busy machine may reply before it has discovered the
        client, which then gets nothing.
        """
        call = self.caller(interface, operation, port, *peers, timeout=5.0)
        return wait_until(lambda: call(request), ignoring=Timeout)

    def publisher(
        self, interface: Interface, port: str, *peers: str, qos: Qos | None = None
    ) -> tuple[Any, Any]:
        """A function that publishes, and the channel."""
        at = self.endpoint(interface, port, qos or Qos(), peers, "subscriber")
        channel = self.ports.advertise(at)
        return channel.bind(interface.operations[0]), channel

    def subscribe(
        self,
        interface: Interface,
        handler: Callable[..., None],
        port: str,
        *peers: str,
        qos: Qos | None = None,
    ) -> None:
        at = self.endpoint(interface, port, qos or Qos(), peers, "publisher")
        self.ports.subscribe(at, {interface.operations[0].name: handler}, self.execution)

    def counts(self, port: str, operation: str) -> Any:
        return self.statistics.of(port, operation)


class RosNetwork:
    """A domain of ROS and one of our presence; a router if the middleware needs one."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.domain = f"test-{uuid.uuid4().hex[:12]}"
        self.domain_id = next_domain_id()
        self.components: list[RosComponent] = []
        self.router_address = ""
        self._router: zenoh.Session | None = None
        if kind == "rmw_zenoh":
            self._router, self.router_address = open_router()

    @property
    def settings(self) -> dict[tuple[str, str], str]:
        if self.kind == "ros1":
            return {(self.kind, "master"): NO_MASTER}
        settings = {(self.kind, "domain_id"): str(self.domain_id)}
        if self.router_address:
            settings[self.kind, "connect"] = self.router_address
        return settings

    def component(self, name: str, threads: int = 1, **addresses: str) -> RosComponent:
        component = RosComponent(self, name, addresses, threads)
        self.components.append(component)
        return component

    def close(self) -> None:
        for component in self.components:
            component.ports.close()
        if self._router:
            self._router.close()
