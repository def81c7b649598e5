"""All monitors of one component: where they are attached, and their state.

In: the settings, the interfaces of the ports, the clock. Out: channels whose calls are monitored,
and the ports that a served or subscribed port consists of: one for each monitored connection, since
a message does not say by which connection it came, and one for all others.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from threading import Lock

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.naming import connection_port, resolve_name
from robocomp_dsl.runtime.connection.arbiter import Arbiter
from robocomp_dsl.runtime.connection.event_container import EventContainer
from robocomp_dsl.runtime.connection.monitor_loader import load_monitor_class
from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors
from robocomp_dsl.runtime.connection.monitored_channel import MonitoredChannel, is_query
from robocomp_dsl.runtime.connection.monitored_connection import MonitoredConnection
from robocomp_dsl.runtime.connection.running_monitor import RunningMonitor
from robocomp_dsl.runtime.middleware.base import Channel, Endpoint, OperationCallable

log = logging.getLogger("robocomp")


@dataclass(frozen=True, slots=True)
class MonitorStatus:
    """The state of one monitored end of a connection, for introspection.

    `state`: `active`, `bypassed` (a monitor could not be created) or `closed` (one failed).
    `events` are the active events of the input with their remaining time in s.
    """

    port: str
    peer: str
    position: str
    monitors: tuple[str, ...]
    state: str
    passed: int
    rejected: int
    failures: int
    constraint: str
    is_winner: bool
    events: tuple[tuple[str, float], ...]


class ComponentMonitors:
    """The monitors of the component `name`; `interfaces` are those of its ports, by name.

    The constructor loads the classes and raises `MonitorError`; `create` makes the objects.
    """

    def __init__(
        self,
        settings: Sequence[ConnectionMonitors],
        name: str,
        prefix: str,
        interfaces: Mapping[str, Interface],
    ) -> None:
        self._name = name
        resolved = [replace(s, peer=resolve_name(prefix, s.peer)) for s in settings]
        self._servers = {s.port: s.peer for s in resolved if s.position == "identify"}
        senders = [s for s in resolved if s.position == "sender"]
        self._settings = [s for s in resolved if s.position == "receiver"]
        self._settings += [_merge(senders, port) for port in dict.fromkeys(s.port for s in senders)]
        self._classes = {
            (s.port, m): load_monitor_class(m, interfaces[s.port].operations)
            for s in self._settings
            for m in s.monitors
        }
        self._receivers: dict[str, list[MonitoredConnection]] = {}
        self._senders: dict[str, MonitoredConnection] = {}

    def create(self, clock: Clock) -> None:
        """Create the monitors; failures of their hooks are reported."""
        for port in dict.fromkeys(s.port for s in self._settings):
            inputs = [s for s in self._settings if s.port == port and s.position == "receiver"]
            constraints = {s.peer: s.constraint for s in inputs if s.constraint}
            events, lock = EventContainer(clock), Lock()
            arbiter = Arbiter(constraints, events, log.warning) if constraints else None
            connections = [self._connection(s, events, lock, arbiter) for s in inputs]
            if connections:
                self._receivers[port] = connections
        for s in self._settings:
            if s.position == "sender":
                self._senders[s.port] = self._connection(s, EventContainer(clock), Lock(), None)
        for connection in self._connections():
            connection.create()

    def _connection(
        self,
        settings: ConnectionMonitors,
        events: EventContainer,
        lock: Lock,
        arbiter: Arbiter | None,
    ) -> MonitoredConnection:
        port, peer = f"{self._name}.{settings.port}", settings.peer
        ends = (peer, port) if settings.position == "receiver" else (port, peer)
        monitors = [
            RunningMonitor(self._classes[settings.port, m], m, " -> ".join(ends))
            for m in settings.monitors
        ]
        return MonitoredConnection(settings, port, peer, monitors, events, lock, arbiter)

    def _connections(self) -> Iterator[MonitoredConnection]:
        for connections in self._receivers.values():
            yield from connections
        yield from self._senders.values()

    def calling_endpoint(self, at: Endpoint) -> Endpoint:
        """The endpoint of a required port; a server that monitors it has a port for it."""
        server = self._servers.get(at.port)
        if server is None:
            return at
        component, _, port = server.rpartition(".")
        own = connection_port(port, f"{at.component}.{at.port}")
        return replace(at, peers=(f"{component}.{own}",))

    def channel(self, port: str, channel: Channel, *, is_topic: bool) -> Channel:
        """The channel of a required or published port; monitored if it has monitors."""
        connection = self._senders.get(port)
        return MonitoredChannel(channel, connection, is_topic=is_topic) if connection else channel

    def receiving_endpoints(
        self,
        port: str,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        *,
        is_topic: bool,
    ) -> Iterator[tuple[Endpoint, Mapping[str, OperationCallable]]]:
        """The endpoints, with their handlers, of which a served or subscribed port consists.

        An arbitrated port has no endpoint for peers without a connection.
        """
        connections = self._receivers.get(port, [])
        for connection in connections:
            name = connection_port(at.port, connection.peer)
            peers = (connection.peer,) if is_topic else ()
            monitored = {
                operation.name: connection.wrap(
                    operation,
                    handlers[operation.name],
                    is_query=is_query(operation, is_topic=is_topic),
                    is_sender=False,
                )
                for operation in at.interface.operations
                if operation.name in handlers
            }
            yield replace(at, port=name, peers=peers), monitored
        if any(connection.arbiter for connection in connections):
            return
        if not connections or not is_topic:
            yield at, handlers
            return
        names = {connection.peer for connection in connections}
        names |= {name.rpartition(".")[0] for name in names}
        others = tuple(peer for peer in at.peers if peer not in names)
        if others:
            yield replace(at, peers=others), handlers

    def statuses(self) -> list[MonitorStatus]:
        """The state of every monitored end of a connection."""
        return [_status(connection) for connection in self._connections()]

    def destroy(self) -> None:
        """Destroy all monitors, after the last message."""
        for connection in self._connections():
            connection.destroy()


def _merge(senders: Sequence[ConnectionMonitors], port: str) -> ConnectionMonitors:
    """The monitors of a calling port: a publication is monitored once for all its receivers."""
    entries = [s for s in senders if s.port == port]
    monitors = dict.fromkeys(monitor for s in entries for monitor in s.monitors)
    return replace(entries[0], peer=" and ".join(s.peer for s in entries), monitors=tuple(monitors))


def _status(connection: MonitoredConnection) -> MonitorStatus:
    settings = connection.settings
    bypassed = any(not monitor.is_created for monitor in connection.monitors)
    return MonitorStatus(
        port=settings.port,
        peer=connection.peer,
        position=settings.position,
        monitors=tuple(monitor.name for monitor in connection.monitors),
        state="closed" if connection.is_closed else "bypassed" if bypassed else "active",
        passed=connection.passed,
        rejected=connection.rejected,
        failures=sum(monitor.failures for monitor in connection.monitors),
        constraint=settings.constraint.text if settings.constraint else "",
        is_winner=connection.is_winner,
        events=connection.events.remaining(),
    )
