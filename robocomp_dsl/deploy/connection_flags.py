"""The command-line options of one process for its connections. Pure.

In: an instance and the deployment. Out: `--middleware`, `--address`, `--connect`, `--qos` and
`--monitors`, in the order of the description.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from robocomp_dsl.deploy.host_middlewares import usable_middlewares
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Connection, Deployment, External, Instance, Monitor, Qos
from robocomp_dsl.model.port_middlewares import port_middlewares
from robocomp_dsl.model.qos_text import format_qos


def middleware_flags(
    deployment: Deployment, instance: Instance, connections: Sequence[Connection]
) -> list[str]:
    """`--middleware` where the deployment says something, and `--address`.

    `connections` are those of `instance`.
    """
    component = instance.component
    chosen = instance.middleware
    if not chosen and component.middleware_span is None:
        chosen = deployment.middleware
    flags = ["--middleware", chosen] if chosen else []
    for port in component.ports:
        named = port_middlewares(instance, port, connections, deployment.middleware)
        names = usable_middlewares(instance, port, named, connections)
        without_flag = port.middlewares or (chosen or component.middleware,)
        if names != without_flag:
            flags += ["--middleware", f"{port.name}={','.join(names)}"]
    for own in instance.own_ports:
        if own.address:
            flags += ["--address", f"{own.port}={own.middleware}:{own.address}"]
    return flags


def connection_flags(instance: Instance, connections: Sequence[Connection]) -> list[str]:
    """`--connect`, `--qos` and `--monitors` of one process."""
    flags: list[str] = []
    qualities: dict[str, list[tuple[str, Qos]]] = {}
    for connection in connections:
        for own_port, peer, peer_port in _own_ends(instance, connection):
            if _looks_for_peer(own_port, peer):
                argument = _peer_argument(instance, peer, peer_port)
                flags += ["--connect", f"{own_port.name}={argument}"]
            name = f"{name_for(instance, peer)}.{peer_port.name}"
            qualities.setdefault(own_port.name, []).append((name, connection.qos))
    for port, requested in qualities.items():
        flags += _qos_flags(port, requested)
    monitors = list(_monitor_entries(instance, connections))
    return [*flags, "--monitors", json.dumps(monitors)] if monitors else flags


def name_for(instance: Instance, other: Instance) -> str:
    """The full name of `other` for the command line of `instance`, without its prefix added."""
    return f"/{other.full_name}" if instance.prefix else other.full_name


def _own_ends(instance: Instance, connection: Connection) -> Iterator[tuple[Port, Instance, Port]]:
    """The own port, peer and port of the peer, for each end of the connection at `instance`."""
    source = (connection.source, connection.source_port)
    target = (connection.target, connection.target_port)
    for (own, own_port), (peer, peer_port) in ((source, target), (target, source)):
        if own is instance:
            yield own_port, peer, peer_port


def _looks_for_peer(own: Port, peer: Instance) -> bool:
    """Whether an own port gets the name of its peer: clients and subscribers look for theirs.

    A publisher looks for an external subscriber, which cannot look for it.
    """
    if own.role in (Role.REQUIRES, Role.SUBSCRIBES):
        return True
    return own.role is Role.PUBLISHES and isinstance(peer, External)


def _peer_argument(instance: Instance, peer: Instance, port: Port) -> str:
    """`component`, or `component.port` if the peer has several ports of that interface.

    Of an external program `name@middleware:address`.
    """
    if isinstance(peer, External):
        return f"{peer.name}@{peer.middleware}:{peer.address}"
    same_kind = [
        p for p in peer.component.ports if p.role is port.role and p.interface is port.interface
    ]
    name = name_for(instance, peer)
    return name if len(same_kind) == 1 else f"{name}.{port.name}"


def _qos_flags(port: str, requested: Sequence[tuple[str, Qos]]) -> Iterator[str]:
    """The quality of service of a port, or of each connection if they differ."""
    first = requested[0][1]
    if all(qos == first for _, qos in requested):
        yield from ("--qos", f"{port}={format_qos(first)}") if first != Qos() else ()
        return
    for peer, qos in requested:
        if qos != Qos():
            yield from ("--qos", f"{port}/{peer}={format_qos(qos)}")


def _monitor_entries(
    instance: Instance, connections: Sequence[Connection]
) -> Iterator[dict[str, Any]]:
    """The entries of `--monitors`, see `runtime.connection.monitor_settings`."""
    for connection in connections:
        receives = [m for m in connection.monitors if m.position == "receiver"]
        sends = [m for m in connection.monitors if m.position == "sender"]
        if connection.target is instance and (receives or connection.condition):
            peer = f"{name_for(instance, connection.source)}.{connection.source_port.name}"
            entry = _entry(connection.target_port, "receiver", peer, receives)
            yield entry | ({"when": connection.condition} if connection.condition else {})
        if connection.source is instance:
            peer = f"{name_for(instance, connection.target)}.{connection.target_port.name}"
            if sends:
                yield _entry(connection.source_port, "sender", peer, sends)
            monitored = receives or connection.condition
            if monitored and not connection.source_port.role.is_topic:
                yield {"port": connection.source_port.name, "at": "identify", "peer": peer}


def _entry(port: Port, position: str, peer: str, monitors: Sequence[Monitor]) -> dict[str, Any]:
    described = [
        {
            "file": str(Path(monitor.file).resolve()),
            "class": monitor.class_name,
            "parameters": dict(monitor.arguments),
            "on_failure": monitor.on_failure,
        }
        for monitor in monitors
    ]
    return {"port": port.name, "at": position, "peer": peer, "monitors": described}
