"""Calls of the interface `ComponentConnections`, and the two ends of a connection.

In: words such as `arm.Laser`. Out: proxies and ports; a refusal becomes a message.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.target import CALL_TIMEOUT_S, ROLE_NAMES, DomainTarget

if TYPE_CHECKING:
    from robocomp_dsl.client import DomainClient
    from robocomp_dsl.runtime.component.component_interface import PortInfo
    from robocomp_dsl.runtime.connection.connections_interface import ComponentConnectionsProxy

SERVE_TIMEOUT_S = 1.0
"""A component serves its connections at the same moment as the interface `Component`."""
CONNECT_TIMEOUT_S = 2.0
"""A peer that runs is connected within this time."""
RECONNECT_TIMEOUT_S = 30.0
"""A component connects again to its router within this time."""
_POLL_S = 0.02
DIRECTIONS = (("requires", "implements"), ("publishes", "subscribesTo"))
"""The roles of source and target, as in `connect source -> target`."""
SEARCHING = ("requires", "subscribesTo")


@dataclass(frozen=True, slots=True)
class ConnectionEnd:
    """One port of a running component; `interface` is `Module::Interface`."""

    component: str
    port: str
    role: str
    interface: str

    @property
    def name(self) -> str:
        """`component.Port`."""
        return f"{self.component}.{self.port}"


@dataclass(frozen=True, slots=True)
class ConnectionEnds:
    """A connection, in the direction in which a deployment writes it."""

    source: ConnectionEnd
    target: ConnectionEnd

    @property
    def searching(self) -> ConnectionEnd:
        """The end that looks for the other: the client, or the subscriber."""
        return self.source if self.source.role in SEARCHING else self.target

    @property
    def found(self) -> ConnectionEnd:
        """The end that is looked for."""
        return self.target if self.source.role in SEARCHING else self.source

    def __str__(self) -> str:
        return f"{self.source.name} -> {self.target.name}"


def connections_proxy(
    client: DomainClient, component: str, timeout: float = CALL_TIMEOUT_S
) -> ComponentConnectionsProxy:
    """The proxy of a component that answers within `timeout` s. Raises `CliError`."""
    from robocomp_dsl.cli.rcdeploy.inspect.component_calls import connect  # noqa: PLC0415
    from robocomp_dsl.runtime.connection.connections_interface import (  # noqa: PLC0415
        COMPONENTCONNECTIONS,
        ComponentConnectionsProxy,
    )

    connect(client, component, timeout)
    channel = client.channel(COMPONENTCONNECTIONS, component, "Component")
    proxy = ComponentConnectionsProxy(channel)
    proxy.set_timeout(CALL_TIMEOUT_S)
    if not proxy.wait_for_server(SERVE_TIMEOUT_S):
        raise CliError(
            EXIT_FINDINGS,
            f"`{component}` does not serve its connections: it runs with an older version of"
            " robocomp_dsl; update it and start it again",
        )
    return proxy


def wait_until_answering(proxy: ComponentConnectionsProxy) -> None:
    """Wait until a component has connected again to its router, and answers."""
    from robocomp_dsl.runtime.errors import MiddlewareError  # noqa: PLC0415

    deadline = time.monotonic() + RECONNECT_TIMEOUT_S
    while True:
        try:
            proxy.getConnections()
        except MiddlewareError:
            if time.monotonic() > deadline:
                raise
            time.sleep(_POLL_S)
        else:
            return


def wait_until_connected(proxy: ComponentConnectionsProxy, port: str, peer: str) -> str:
    """Wait until a port is connected to a peer; the reason why it is not, or empty."""
    from robocomp_dsl.runtime.connection.connections_interface import ConnectionState  # noqa: PLC0415

    deadline = time.monotonic() + CONNECT_TIMEOUT_S
    while True:
        known = [i for i in proxy.getConnections() if i.port == port]
        states = [i for i in known if i.peer in (peer, peer.rpartition(".")[0])]
        if any(info.state is ConnectionState.Connected for info in states):
            return ""
        if time.monotonic() > deadline:
            reasons = [info.reason or f"`{peer}` does not answer" for info in states]
            return reasons[0] if reasons else f"`{port}` does not know `{peer}`"
        time.sleep(_POLL_S)


@contextmanager
def refusals_of(component: str) -> Iterator[None]:
    """Turn a refusal into a `CliError`."""
    from robocomp_dsl.runtime.connection.connections_interface import Refusal  # noqa: PLC0415

    try:
        yield
    except Refusal as refusal:
        raise CliError(EXIT_FINDINGS, f"`{component}` refuses: {refusal.reason}") from None


def find_ports(client: DomainClient, target: DomainTarget, word: str) -> list[ConnectionEnd]:
    """The ports of `arm.Laser`, or all ports of `arm`. Raises `CliError`."""
    from robocomp_dsl.cli.rcdeploy.inspect.component_calls import connect  # noqa: PLC0415
    from robocomp_dsl.diagnostics import did_you_mean  # noqa: PLC0415

    component, name = target.split(word)
    infos: list[PortInfo] = connect(client, component).getInfo().ports
    ends = [ConnectionEnd(component, i.name, i.role, i.declared) for i in infos]
    found = [end for end in ends if name in ("", end.port)]
    if not found:
        names = sorted({end.port for end in ends})
        hint = did_you_mean(name, names) or f"it has {', '.join(names) or 'none'}"
        raise CliError(EXIT_FINDINGS, f"`{component}` has no port `{name}`; {hint}")
    return found


def find_ends(
    client: DomainClient, target: DomainTarget, first: str, second: str
) -> ConnectionEnds:
    """The connection between two ports, given in any order. Raises `CliError`."""
    ours, theirs = find_ports(client, target, first), find_ports(client, target, second)
    possible = [
        ConnectionEnds(source, end)
        for some, others in ((ours, theirs), (theirs, ours))
        for source in some
        for end in others
        if (source.role, end.role) in DIRECTIONS and source.interface == end.interface
    ]
    if len(possible) == 1:
        return possible[0]
    if possible:
        listed = "; ".join(str(ends) for ends in possible)
        raise CliError(EXIT_FINDINGS, f"which connection? Name both ports: {listed}")
    raise CliError(EXIT_FINDINGS, _no_connection(ours, theirs))


def _no_connection(ours: list[ConnectionEnd], theirs: list[ConnectionEnd]) -> str:
    if len(ours) == len(theirs) == 1:
        a, b = ours[0], theirs[0]
        if a.interface != b.interface:
            return f"`{a.name}` is {a.interface}, and `{b.name}` is {b.interface}"
        return (
            f"`{a.name}` is {ROLE_NAMES[a.role]}, `{b.name}` is {ROLE_NAMES[b.role]}: a connection"
            " runs from a required to an implemented port, or from a published to a subscribed one"
        )
    listed = "; ".join(
        f"{end.name} ({ROLE_NAMES[end.role]} {end.interface})" for end in (*ours, *theirs)
    )
    return f"no two of these ports fit: {listed}"
