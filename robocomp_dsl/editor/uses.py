"""Who uses whom: components through their interfaces, instances through the wires of a deployment.

In: components, or a deployment. Out: `Use` values. A component that requires an interface uses
those that implement it; one that subscribes to a topic uses those that publish it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.files import identity
from robocomp_dsl.editor.session import Session
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.deployment import Connection, Deployment, Instance
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span, UnreadableSource

PROVIDERS = {Role.REQUIRES: Role.IMPLEMENTS, Role.SUBSCRIBES: Role.PUBLISHES}
"""What a user does with an interface, and what the one does that it uses."""

Party = Component | Instance | Interface


@dataclass(frozen=True, slots=True)
class Use:
    """`user` uses `provider`; `user_span` is where the file of the user says so."""

    user: Party
    user_span: Span
    provider: Party


def interface_key(interface: Interface) -> tuple[str, int]:
    """The same for every object that was made from one declaration."""
    return identity(interface.span.source.path), interface.span.start


def components(session: Session) -> Iterator[Component]:
    """All components that are known, each once."""
    for path in session.every_file():
        if path.suffix.lower() == ".cdsl":
            model = _model(session, path)
            if isinstance(model, Component):
                yield model


def uses_of_components(found: Iterable[Component]) -> list[Use]:
    """Every pair of components that a shared interface brings together."""
    ports: dict[tuple[Role, tuple[str, int]], list[tuple[Component, Port]]] = {}
    for one in found:
        for port in one.ports:
            ports.setdefault((port.role, interface_key(port.interface)), []).append((one, port))
    return [
        Use(user, user_port.span, provider)
        for (role, key), users in ports.items()
        if role in PROVIDERS
        for user, user_port in users
        for provider, _ in ports.get((PROVIDERS[role], key), ())
    ]


def uses_of_interface(interface: Interface, found: Iterable[Component]) -> list[Use]:
    """Who requires it or subscribes to it, and who implements or publishes it."""
    uses = []
    for one in found:
        for port in one.ports:
            if interface_key(port.interface) != interface_key(interface):
                continue
            if port.role in PROVIDERS:
                uses.append(Use(one, port.span, interface))
            else:
                uses.append(Use(interface, interface.span, one))
    return uses


def uses_of_instances(deployment: Deployment) -> list[Use]:
    """What is wired, written or implied."""
    return [_of_wire(one) for one in deployment.connections]


def _of_wire(one: Connection) -> Use:
    published = one.source_port.role is Role.PUBLISHES
    user, provider = (one.target, one.source) if published else (one.source, one.target)
    return Use(user, user.span if one.implied else one.span, provider)


def _model(session: Session, path: Path) -> object:
    try:
        return session.checked(path).model
    except UnreadableSource:
        return None
