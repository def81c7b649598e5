"""Which middlewares a port uses, if its peers are on other hosts. Pure.

A port on several middlewares takes the first one that its peer has, too. Between hosts that must be
one that connects hosts, so a port that looks for a peer on another host uses only those.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, External, Instance


def usable_middlewares(
    instance: Instance, port: Port, names: Sequence[str], connections: Iterable[Connection]
) -> tuple[str, ...]:
    """`names`, without those that cannot reach a peer; all of them if none can.

    `connections` are those of `instance`.
    """
    looks_for_peers = port.role in (Role.REQUIRES, Role.SUBSCRIBES)
    if len(names) < 2 or not looks_for_peers:
        return tuple(names)
    peers = (
        target if source is instance else source
        for source, source_port, target, target_port in map(_ends, connections)
        if (instance, port) in ((source, source_port), (target, target_port))
    )
    remote = any(
        not isinstance(peer, External) and peer.host.machine != instance.host.machine
        for peer in peers
    )
    if not remote:
        return tuple(names)
    known = KnownMiddlewares()
    crossing = [name for name in names if _connects_hosts(name, known)]
    return tuple(crossing or names)


def _ends(connection: Connection) -> tuple[Instance, Port, Instance, Port]:
    return connection.source, connection.source_port, connection.target, connection.target_port


def _connects_hosts(name: str, known: KnownMiddlewares) -> bool:
    description = known.describe(name)
    return description is None or description.capabilities.between_hosts
