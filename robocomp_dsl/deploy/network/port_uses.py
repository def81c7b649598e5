"""What each component of a deployment does with its ports: whom it calls, what it publishes.

In: a resolved deployment. Out: `PortUse`s by component, in the words of the descriptions. Pure. The
interfaces that the runtime adds are included: `Component`, clocks, lock-step.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import StrEnum

from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.connection_index import ConnectionIndex
from robocomp_dsl.model.deployment import Connection, Deployment, External, Instance
from robocomp_dsl.model.interface import Pattern
from robocomp_dsl.model.port_middlewares import port_middlewares
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.runtime.component.naming import ANY, connection_port

HOUSE = "zenoh"
CLOCK = "RoboCompClock::Clock"
FOLLOWER = "RoboCompLockStep::Follower"
LEADER = "RoboCompLockStep::Leader"
COMPONENT_PORT = "Component"
COMPONENT_INTERFACES = (
    "RoboCompComponent::Component",
    "RoboCompComponentSchema::ComponentSchema",
    "RoboCompComponentConnections::ComponentConnections",
)
CLOCK_PORT = "Clock of the deployment"
FOLLOWER_PORT, LEADER_PORT = "Follower", "Leader"


class PortAction(StrEnum):
    """What a component does with a port."""

    SERVES = "serves"
    CALLS = "calls"
    PUBLISHES = "publishes"
    SUBSCRIBES = "subscribes to"


class PortUse(ValueRecord):
    """One use of a port of a component.

    `peer` is the full name of the component that it calls or subscribes to, and `peer_port` its
    port; `ANY` is any. `queries` and `commands`: the interface has such operations. `on_house`: the
    messages travel over zenoh; otherwise only the presence of the port does. `from_runtime`: the
    runtime adds it to every component.
    """

    action: PortAction
    interface: str
    port: str
    peer: str = ""
    peer_port: str = ""
    queries: bool = True
    commands: bool = False
    on_house: bool = True
    from_runtime: bool = False


class AddedConnection(ValueRecord):
    """A connection that the operator made at run time: full names and ports.

    As in `Connection`, `source` requires or publishes, `target` implements or subscribes.
    """

    source: str
    source_port: str
    target: str
    target_port: str


def port_uses(
    deployment: Deployment, added_connections: Iterable[AddedConnection] = ()
) -> dict[str, tuple[PortUse, ...]]:
    """The uses of each component, by full name; with the added connections."""
    added = tuple(added_connections)
    index = ConnectionIndex(deployment.connections)
    return {
        instance.full_name: tuple(
            dict.fromkeys(
                (
                    *_declared(deployment, instance, index.at(instance), added),
                    *_clock(deployment, instance),
                    *_runtime(),
                )
            )
        )
        for instance in deployment.instances
        if not instance.is_program
    }


def _runtime() -> Iterator[PortUse]:
    for interface in COMPONENT_INTERFACES:
        yield PortUse(
            PortAction.SERVES, interface, COMPONENT_PORT, commands=True, from_runtime=True
        )


def _clock(deployment: Deployment, instance: Instance) -> Iterator[PortUse]:
    """The uses that follow from the clock of the deployment."""
    clock = deployment.clock
    source = clock.source
    if source is None:
        return
    if not clock.lockstep:
        if instance is not source:
            yield PortUse(
                PortAction.SUBSCRIBES, CLOCK, CLOCK_PORT, source.full_name, ANY, from_runtime=True
            )
    elif instance is not source:
        yield PortUse(PortAction.SERVES, FOLLOWER, FOLLOWER_PORT, from_runtime=True)
        yield PortUse(
            PortAction.CALLS, LEADER, LEADER_PORT, source.full_name, LEADER_PORT, from_runtime=True
        )
    else:
        yield PortUse(PortAction.SERVES, LEADER, LEADER_PORT, from_runtime=True)
        for other in deployment.instances:
            if other is not source and not other.is_program:
                name = f"{FOLLOWER_PORT} {other.full_name}"
                yield PortUse(
                    PortAction.CALLS,
                    FOLLOWER,
                    name,
                    other.full_name,
                    FOLLOWER_PORT,
                    from_runtime=True,
                )


def _declared(
    deployment: Deployment,
    instance: Instance,
    connections: Sequence[Connection],
    added: Sequence[AddedConnection],
) -> Iterator[PortUse]:
    """The uses of the ports of the CDSL file."""
    for port in instance.component.ports:
        uses = _PortUses(deployment, instance, port, connections, added)
        yield from uses.plain()
        if deployment.clock.lockstep and port.interface.qualified != CLOCK:
            yield from uses.timed()


class _PortUses:
    """The uses of one port of `instance`, which has the `connections`."""

    def __init__(
        self,
        deployment: Deployment,
        instance: Instance,
        port: Port,
        connections: Sequence[Connection],
        added: Sequence[AddedConnection],
    ) -> None:
        self._instance = instance
        self._port = port
        self._own_connections = connections
        self._added = added
        patterns = {port.pattern(operation) for operation in port.interface.operations}
        self._queries = bool(patterns - {Pattern.COMMAND})
        self._commands = Pattern.COMMAND in patterns
        middlewares = port_middlewares(instance, port, connections, deployment.middleware)
        self._on_house = HOUSE in middlewares or port.interface.qualified == CLOCK

    def plain(self) -> Iterator[PortUse]:
        """The uses of the interface itself."""
        role, name = self._port.role, self._port.name
        if role is Role.PUBLISHES:
            yield self._use(PortAction.PUBLISHES, name)
        elif role is Role.IMPLEMENTS:
            for own in (name, *self._connection_ports()):
                yield self._use(PortAction.SERVES, own)
        else:
            yield from self._searching(
                PortAction.CALLS if role is Role.REQUIRES else PortAction.SUBSCRIBES
            )

    def _use(self, action: PortAction, port: str, peer: str = "", peer_port: str = "") -> PortUse:
        return PortUse(
            action,
            self._port.interface.qualified,
            port,
            peer,
            peer_port,
            self._queries,
            self._commands,
            self._on_house,
        )

    def _searching(self, action: PortAction) -> Iterator[PortUse]:
        """The uses of a port that looks for its peers."""
        name = self._port.name
        connections = list(self._connections())
        peers_added = list(self._added_peers())
        if not connections and not peers_added and not self._has_external_peer():
            yield self._use(action, name, ANY, ANY)
        for peer, port, monitored in connections:
            yield self._use(action, name, peer.full_name, self._peer_port(peer, port, action))
            if monitored and action is PortAction.CALLS:
                own = f"{self._instance.full_name}.{name}"
                yield self._use(action, name, peer.full_name, connection_port(port.name, own))
            elif monitored:
                own = connection_port(name, f"{peer.full_name}.{port.name}")
                yield self._use(action, own, peer.full_name, self._peer_port(peer, port, action))
        for peer_name, port_name in peers_added:
            yield self._use(action, name, peer_name, port_name)

    def timed(self) -> Iterator[PortUse]:
        """The uses of the timed interface, in lock-step: all of them are queries."""
        role, name = self._port.role, self._port.name
        if role is Role.REQUIRES:
            for use in self._searching(PortAction.CALLS):
                yield self._timed(use)
        elif role is Role.PUBLISHES:
            for peer, port, _ in self._connections():
                own = f"{name} to {peer.full_name}.{port.name}"
                yield self._timed(self._use(PortAction.CALLS, own, peer.full_name, port.name))
        else:
            for own in (name, *self._connection_ports()):
                yield self._timed(self._use(PortAction.SERVES, own))

    def _timed(self, use: PortUse) -> PortUse:
        interface = f"{use.interface} in step"
        return use.replace(interface=interface, queries=True, commands=False, on_house=True)

    def _all_connections(self) -> Iterator[tuple[Instance, Port, Connection]]:
        """The other end of each connection of this port, and the connection."""
        for connection in self._own_connections:
            source = (connection.source, connection.source_port)
            target = (connection.target, connection.target_port)
            for (own, own_port), (peer, peer_port) in ((source, target), (target, source)):
                if own is self._instance and own_port is self._port:
                    yield peer, peer_port, connection

    def _connections(self) -> Iterator[tuple[Instance, Port, bool]]:
        """Peers that are components, and whether the receiver monitors the connection."""
        for peer, peer_port, connection in self._all_connections():
            if not isinstance(peer, External):
                receives = any(m.position == "receiver" for m in connection.monitors)
                yield peer, peer_port, receives or bool(connection.condition)

    def _has_external_peer(self) -> bool:
        return any(isinstance(peer, External) for peer, _, _ in self._all_connections())

    def _connection_ports(self) -> Iterator[str]:
        """The own ports of monitored connections of a served or subscribed port."""
        for peer, port, monitored in self._connections():
            if monitored:
                yield connection_port(self._port.name, f"{peer.full_name}.{port.name}")

    def _peer_port(self, peer: Instance, port: Port, action: PortAction) -> str:
        """A subscription names the component only, if it has one such port."""
        same = [
            p for p in peer.component.ports if p.role is port.role and p.interface is port.interface
        ]
        return ANY if action is PortAction.SUBSCRIBES and len(same) == 1 else port.name

    def _added_peers(self) -> Iterator[tuple[str, str]]:
        name, port = self._instance.full_name, self._port.name
        for each in self._added:
            service = self._port.role is Role.REQUIRES
            own = (each.source, each.source_port) if service else (each.target, each.target_port)
            if own == (name, port):
                yield (
                    (each.target, each.target_port) if service else (each.source, each.source_port)
                )
