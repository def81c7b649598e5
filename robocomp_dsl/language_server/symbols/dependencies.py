"""Dependencies of components through interfaces, and of instances through connections.

In: components, or a deployment. Out: `Dependency` values. A component that requires an interface
depends on the components that implement it; a subscriber depends on the publishers of its topic.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.deployment import Connection, Deployment, Instance
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span, UnreadableSource

SERVER_ROLES = {Role.REQUIRES: Role.IMPLEMENTS, Role.SUBSCRIBES: Role.PUBLISHES}
"""Role of the client's port to the role of the server's port."""

Participant = Component | Instance | Interface


@dataclass(frozen=True, slots=True)
class Dependency:
    """`client` uses `server`; `client_span` is the place in the client's file that says so."""

    client: Participant
    client_span: Span
    server: Participant


def interface_key(interface: Interface) -> tuple[str, int]:
    """Identifies the declaration: equal for all objects that were created from it."""
    return canonical_path(interface.span.source.path), interface.span.start


def known_components(session: Session) -> Iterator[Component]:
    """The components in all known files."""
    for path in session.known_files():
        if path.suffix.lower() == ".cdsl":
            model = _model(session, path)
            if isinstance(model, Component):
                yield model


def component_dependencies(components: Iterable[Component]) -> list[Dependency]:
    """The dependencies between components that share an interface."""
    ports: dict[tuple[Role, tuple[str, int]], list[tuple[Component, Port]]] = {}
    for component in components:
        for port in component.ports:
            key = (port.role, interface_key(port.interface))
            ports.setdefault(key, []).append((component, port))
    return [
        Dependency(client, client_port.span, server)
        for (role, key), clients in ports.items()
        if role in SERVER_ROLES
        for client, client_port in clients
        for server, _ in ports.get((SERVER_ROLES[role], key), ())
    ]


def interface_dependencies(
    interface: Interface, components: Iterable[Component]
) -> list[Dependency]:
    """The components that require or subscribe to it, and those that implement or publish it."""
    dependencies = []
    for component in components:
        for port in component.ports:
            if interface_key(port.interface) != interface_key(interface):
                continue
            if port.role in SERVER_ROLES:
                dependencies.append(Dependency(component, port.span, interface))
            else:
                dependencies.append(Dependency(interface, interface.span, component))
    return dependencies


def instance_dependencies(deployment: Deployment) -> list[Dependency]:
    """The dependencies through explicit and implicit connections."""
    return [_connection_dependency(connection) for connection in deployment.connections]


def _connection_dependency(connection: Connection) -> Dependency:
    client, server = connection.source, connection.target
    if connection.source_port.role is Role.PUBLISHES:
        client, server = server, client
    return Dependency(client, client.span if connection.implied else connection.span, server)


def _model(session: Session, path: Path) -> object:
    try:
        return session.checked(path).model
    except UnreadableSource:
        return None
