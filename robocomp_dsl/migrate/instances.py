"""The draft of a deployment: instances, connections, and addresses.

In: the results of `deployment` and `connections`. Out: `DeploymentDraft`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.migrate.ice import Address
from robocomp_dsl.migrate.migrated_component import MigratedComponent, MigratedConfig
from robocomp_dsl.model.component import Component, Role
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span

LOCAL_HOSTS = ("", "localhost", "*", "::1")
COMMON_BEHAVIOR = "commonbehavior"
"""Suffix of the interfaces by which RoboComp monitored every component."""


@dataclass(slots=True)
class MigratedInstance:
    """One component of the deployment. `peer_interfaces` are those of a stand-in."""

    name: str
    span: Span
    migrated: MigratedComponent | None = None
    config: MigratedConfig | None = None
    host: str = ""
    user: str = ""
    endpoints: list[Address] = field(default_factory=list)
    port: int = 0
    after: list[str] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)
    peer_interfaces: list[Interface] = field(default_factory=list)

    @property
    def component(self) -> Component | None:
        """The component; None if its description is unknown."""
        return self.migrated.component if self.migrated else None

    def serves(self, interface: Interface) -> str | None:
        """The port that serves `interface`, compared by name; None if there is none."""
        if self.component is None:
            return interface.name if self.stands_in_for(interface) else None
        for port in self.component.with_role(Role.IMPLEMENTS):
            if same_interface(port.interface, interface):
                return port.name
        return None

    def stands_in_for(self, interface: Interface) -> bool:
        """Whether this is a stand-in with `interface`."""
        return any(same_interface(peer, interface) for peer in self.peer_interfaces)


@dataclass(slots=True)
class DeploymentDraft:
    """The deployment. A connection is `(client, port, server, port)`."""

    instances: list[MigratedInstance]
    connections: list[tuple[str, str, str, str]] = field(default_factory=list)


def same_interface(interface: Interface, other: Interface) -> bool:
    """Whether two interfaces have the same module and name."""
    return (interface.module, interface.name) == (other.module, other.name)


class InstanceNames:
    """Unique names of instances; a stand-in has none of the names of `components` either."""

    def __init__(self, components: Iterable[str] = ()) -> None:
        self.taken: set[str] = set()
        self._components = frozenset(components)

    def claim_stand_in(self, requested: str) -> str:
        """A free name of an instance and of its component."""
        name = self.claim(requested)
        return name if name not in self._components else self.claim_stand_in(f"{name}_peer")

    def claim(self, requested: str) -> str:
        """A free DDSL name based on `requested`."""
        name = re.sub(r"\W", "_", requested, flags=re.ASCII) or "component"
        name = f"_{name}" if name[0].isdigit() else name
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        return name


def address_matches(called: Address, listening: Address, other: MigratedInstance) -> bool:
    """Whether a client's address is the server's; all addresses of this machine are equal."""
    if called.port != listening.port or not called.port:
        return False
    hosts = {host_name(listening.host) or host_name(other.host)}
    return host_name(called.host) in hosts | {""} or hosts == {""}


def host_name(host: str) -> str:
    """A host name of a configuration; empty for this machine."""
    return "" if host in LOCAL_HOSTS or host.startswith("127.") or host == "0.0.0.0" else host  # noqa: S104


def hosts_of(instances: Sequence[MigratedInstance]) -> dict[str, tuple[str, str]]:
    """The hosts that are not this machine: address to name and user."""
    hosts: dict[str, tuple[str, str]] = {}
    names = InstanceNames()
    for instance in instances:
        address = host_name(instance.host)
        if address and address not in hosts:
            users = [o.user for o in instances if o.host == instance.host and o.user]
            hosts[address] = (names.claim(f"host_{address}"), users[0] if users else "")
    return hosts


def host_of(instance: MigratedInstance) -> str:
    """The address of an instance's host; empty for this machine."""
    return host_name(instance.host)
