"""The ports of a component with monitors.

In: the ports without monitors, and the monitors. Out: ports whose calls and messages pass through
them. A served or subscribed port consists of one port for each monitored connection, because a
message does not say by which connection it came, and of one for all other peers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.naming import connection_port
from robocomp_dsl.runtime.connection.component_monitors import ComponentMonitors
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.monitored_channel import MonitoredChannel, is_query
from robocomp_dsl.runtime.connection.ports import Channel, OperationCallable, Ports


class MonitoredPorts:
    """The ports that a component's worker uses; see `ports.Ports`."""

    def __init__(self, inner: Ports, monitors: ComponentMonitors) -> None:
        self._inner = inner
        self._monitors = monitors

    def proxy(self, at: Endpoint) -> Channel:
        """See `Ports`; a server that monitors this connection has a port of its own for it."""
        server = self._monitors.server_port(at.port)
        if server:
            component, _, port = server.rpartition(".")
            at = replace(at, peers=(f"{component}.{connection_port(port, at.name)}",))
        return self._monitored(at.port, self._inner.proxy(at), is_topic=False)

    def advertise(self, at: Endpoint) -> Channel:
        """See `Ports`."""
        return self._monitored(at.port, self._inner.advertise(at), is_topic=True)

    def _monitored(self, port: str, channel: Channel, *, is_topic: bool) -> Channel:
        sender = self._monitors.sender(port)
        return MonitoredChannel(channel, sender, is_topic=is_topic) if sender else channel

    def serve(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `Ports`; an arbitrated port serves its connections only."""
        connections = self._monitors.receivers(at.port)
        for connection in connections:
            own = replace(at, port=connection_port(at.port, connection.peer))
            monitored = _monitored_handlers(at, handlers, connection.wrap, is_topic=False)
            self._inner.serve(own, monitored, execution)
        if not any(connection.arbiter for connection in connections):
            self._inner.serve(at, handlers, execution)

    def subscribe(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """See `Ports`; an arbitrated port subscribes to its connections only."""
        connections = self._monitors.receivers(at.port)
        if not connections:
            self._inner.subscribe(at, handlers, execution)
            return
        names = {connection.peer for connection in connections}
        for connection in connections:
            own = _endpoint_of_connection(at, connection.peer)
            monitored = _monitored_handlers(at, handlers, connection.wrap, is_topic=True)
            self._inner.subscribe(own, monitored, execution)
        # A connection may name the component only, if it has one such port.
        names |= {_component(name) for name in names}
        others = tuple(peer for peer in at.peers if peer not in names)
        external = tuple(peer for peer in at.external if peer.component not in names)
        is_arbitrated = any(connection.arbiter for connection in connections)
        if (others or external) and not is_arbitrated:
            # Without any peer it would also receive the monitored messages: it names itself.
            rest = replace(at, peers=others or (at.name,), external=external)
            self._inner.subscribe(rest, handlers, execution)

    def find_servers(self, interface: Interface, timeout: float) -> list[str]:
        """See `Ports`."""
        return self._inner.find_servers(interface, timeout)

    def publish_state(self, state: str) -> None:
        """See `Ports`."""
        self._inner.publish_state(state)

    def interrupt(self) -> None:
        """See `Ports`."""
        self._inner.interrupt()

    def close(self) -> None:
        """See `Ports`."""
        self._inner.close()


def _endpoint_of_connection(at: Endpoint, peer: str) -> Endpoint:
    """The endpoint of a subscribed port that receives from one peer."""
    external = tuple(e for e in at.external if e.component == _component(peer))
    if not external:
        return replace(at, port=connection_port(at.port, peer), peers=(peer,), external=())
    # A program outside knows the port by its own name and address.
    used = tuple(dict.fromkeys(e.middleware for e in external))
    return replace(at, peers=(peer,), external=external, middlewares=used)


def _component(peer: str) -> str:
    """`component` of `component.Port`; an external peer has one port."""
    return peer.rpartition(".")[0]


def _monitored_handlers(
    at: Endpoint,
    handlers: Mapping[str, OperationCallable],
    wrap: Callable[..., OperationCallable],
    *,
    is_topic: bool,
) -> dict[str, OperationCallable]:
    """The handlers for messages of one connection."""

    def monitored() -> Iterator[tuple[str, Any]]:
        for operation in at.interface.operations:
            if handler := handlers.get(operation.name):
                query = is_query(operation, is_topic=is_topic)
                yield operation.name, wrap(operation, handler, is_query=query, is_sender=False)

    return dict(monitored())
