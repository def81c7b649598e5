"""How the ports of a bridge are connected: with foreign programs, and with components.

In: a bridge and what its middlewares can do. Out: the default connections, addresses and qualities
of service of the component, and the external programs of its deployment.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from robocomp_dsl.generate.names import NameScope
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgePort
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.deployment import Qos
from robocomp_dsl.model.qos_text import format_qos
from robocomp_dsl.record import ValueRecord

Query = Callable[[str], bool]
"""Whether a middleware, by name, has a capability."""

_PEER_ROLES = {
    Role.SUBSCRIBES: Role.PUBLISHES,
    Role.PUBLISHES: Role.SUBSCRIBES,
    Role.REQUIRES: Role.IMPLEMENTS,
    Role.IMPLEMENTS: Role.REQUIRES,
}
_WORD = re.compile(r"[A-Za-z0-9]+")
_LONGEST_NAME = 40


class ForeignPeer(ValueRecord):
    """A program outside of the deployment: `role` and `interface` are those of its port."""

    name: str
    middleware: str
    address: str
    role: Role
    interface: str
    port: BridgePort


class BridgeWiring(ValueRecord):
    """`connections`, `addresses` and `qualities` are as on the command line of a component."""

    peers: tuple[ForeignPeer, ...]
    connections: tuple[str, ...]
    addresses: tuple[str, ...]
    qualities: tuple[str, ...]
    own_addresses: tuple[BridgePort, ...]


class MiddlewareQueries(ValueRecord):
    """`has_external_peers`: programs that are no components; `names_topics`: of ROS."""

    has_external_peers: Query
    names_topics: Query


def wiring_of(bridge: Bridge, queries: MiddlewareQueries) -> BridgeWiring:
    """The wiring of all ports of a bridge."""
    foreign = [p for p in bridge.ports if p.address and queries.has_external_peers(p.middleware)]
    peers = tuple(_peers(bridge, foreign))
    own = tuple(
        port
        for port in foreign
        if port.role is Role.IMPLEMENTS
        or (port.role is Role.PUBLISHES and queries.names_topics(port.middleware))
    )
    connections = [
        f"{peer.port.name}={peer.name}@{peer.middleware}:{peer.port.address}"
        for peer in peers
        if peer.port.role is not Role.IMPLEMENTS
    ]
    connections += [
        f"{port.name}={port.address}"
        for port in bridge.ports
        if port.address and port not in foreign and port.role in (Role.SUBSCRIBES, Role.REQUIRES)
    ]
    return BridgeWiring(
        peers,
        tuple(connections),
        tuple(f"{port.name}={port.middleware}:{port.address}" for port in own),
        tuple(f"{p.name}={format_qos(p.qos)}" for p in bridge.ports if p.qos != Qos()),
        own,
    )


def _peers(bridge: Bridge, ports: list[BridgePort]) -> Iterator[ForeignPeer]:
    scope = NameScope({bridge.name.lower(), bridge.name})
    for port in ports:
        role = _PEER_ROLES[port.role]
        address = "" if role is Role.REQUIRES else port.address
        name = scope.claim(peer_name(port.address, port.name))
        yield ForeignPeer(name, port.middleware, address, role, port.interface.qualified, port)


def peer_name(address: str, port: str) -> str:
    """A name for the program at an address: `/rover/left/state:o` is `rover_left_state_o`."""
    path = address if address.startswith("/") else re.split(r"[:@ ]", address)[0]
    words = _WORD.findall(path.partition("@")[0])
    name = "_".join(words)[:_LONGEST_NAME].strip("_")
    return name if name and not name[0].isdigit() else f"{port}_peer"
