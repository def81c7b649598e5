"""All monitors of one component: where they are attached, and their state.

In: the settings, the ports of the component, the clock. Out: the monitored ends of connections by
port, and their state.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from threading import Lock

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.naming import resolve_name
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime.connection.arbiter import Arbiter
from robocomp_dsl.runtime.connection.event_container import EventContainer
from robocomp_dsl.runtime.connection.monitor_loader import load_monitor_class
from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors
from robocomp_dsl.runtime.connection.monitored_connection import MonitoredConnection
from robocomp_dsl.runtime.connection.running_monitor import RunningMonitor
from robocomp_dsl.runtime.errors import MonitorError

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
    """The monitors of one component. A port has the name that its peers see.

    The constructor loads the classes and raises `MonitorError`; `create` makes the objects.
    """

    def __init__(self, spec: ComponentSpec, settings: RunSettings) -> None:
        self._name = settings.full_name(spec.name)
        interfaces = _interfaces(spec)
        resolved = [
            replace(s, peer=resolve_name(settings.prefix, s.peer)) for s in settings.monitors
        ]
        for s in resolved:
            _check_role(s, spec)
        self._servers = {s.port: s.peer for s in resolved if s.position == "identify"}
        senders = [s for s in resolved if s.position == "sender"]
        self._settings = [s for s in resolved if s.position == "receiver"]
        self._settings += [_merge(senders, port) for port in dict.fromkeys(s.port for s in senders)]
        self._classes = {
            (s.port, m): load_monitor_class(m, interfaces[s.port].operations)
            for s in self._settings
            for m in s.monitors
        }
        self._remaps = {p.name: settings.remaps.get(p.name, p.name) for p in _own_ports(spec)}
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
                self._receivers[self._remaps.get(port, port)] = connections
        for s in self._settings:
            if s.position == "sender":
                sender = self._connection(s, EventContainer(clock), Lock(), None)
                self._senders[self._remaps.get(s.port, s.port)] = sender
        for connection in self._connections():
            connection.create()

    def _connection(
        self,
        settings: ConnectionMonitors,
        events: EventContainer,
        lock: Lock,
        arbiter: Arbiter | None,
    ) -> MonitoredConnection:
        port = f"{self._name}.{self._remaps.get(settings.port, settings.port)}"
        peer = settings.peer
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

    def server_port(self, port: str) -> str:
        """The server (`component.Port`) that monitors the connection of a port; "" if none does."""
        return self._servers.get(port, "")

    def sender(self, port: str) -> MonitoredConnection | None:
        """The monitored end of a required or published port."""
        return self._senders.get(port)

    def receivers(self, port: str) -> list[MonitoredConnection]:
        """The monitored connections into a served or subscribed port."""
        return self._receivers.get(port, [])

    def statuses(self) -> list[MonitorStatus]:
        """The state of every monitored end of a connection."""
        return [_status(connection) for connection in self._connections()]

    def destroy(self) -> None:
        """Destroy all monitors, after the last message."""
        for connection in self._connections():
            connection.destroy()


def _own_ports(spec: ComponentSpec) -> tuple[ServedPort | CalledPort, ...]:
    """The ports that a remap renames for their peers."""
    return (*spec.implements, *spec.publishes)


def _interfaces(spec: ComponentSpec) -> dict[str, Interface]:
    """The interfaces of all ports."""
    called = (*spec.requires, *spec.publishes)
    served = (*spec.implements, *spec.subscribes)
    interfaces = {port.name: port.proxy.INTERFACE for port in called}
    return interfaces | {port.name: port.interface for port in served}


def _check_role(settings: ConnectionMonitors, spec: ComponentSpec) -> None:
    """Check that the component has the port, at that end. Raises `MonitorError`."""
    ports: tuple[ServedPort | CalledPort, ...] = spec.requires
    if settings.position == "receiver":
        ports = (*spec.implements, *spec.subscribes)
    elif settings.position == "sender":
        ports = (*spec.requires, *spec.publishes)
    if settings.port not in (port.name for port in ports):
        raise MonitorError(
            f"{spec.name} has no port `{settings.port}` that is the {settings.position} of a"
            f" connection with {settings.peer}"
        )


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
