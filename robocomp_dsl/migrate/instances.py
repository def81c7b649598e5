"""What a deployment consists of: instances, wires, and the addresses by which they are found.

In: what `deployment` and `wiring` find out. Out: `Draft`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from robocomp_dsl.migrate.ice import Address
from robocomp_dsl.migrate.moved import Moved, MovedConfig
from robocomp_dsl.model.component import Component, Role
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span

HERE = ("", "localhost", "*", "::1")
COMMON = "commonbehavior"
"""The end of the interfaces by which RoboComp watched every component."""


@dataclass(slots=True)
class Instance:
    """One component of the deployment. `peer` has the interfaces of a stand-in."""

    name: str
    span: Span
    moved: Moved | None = None
    config: MovedConfig | None = None
    host: str = ""
    user: str = ""
    listens: list[Address] = field(default_factory=list)
    port: int = 0
    after: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    peer: list[Interface] = field(default_factory=list)

    @property
    def component(self) -> Component | None:
        """What it is, where its description is known."""
        return self.moved.component if self.moved else None

    def serves(self, interface: Interface) -> str | None:
        """The port that serves `interface`; interfaces of several runs are compared by name."""
        if self.component is None:
            return interface.name if self.has_peer(interface) else None
        for port in self.component.with_role(Role.IMPLEMENTS):
            if same(port.interface, interface):
                return port.name
        return None

    def has_peer(self, interface: Interface) -> bool:
        """Whether the stand-in has `interface`."""
        return any(same(one, interface) for one in self.peer)


@dataclass(slots=True)
class Draft:
    """The deployment. A wire is `(instance, port, instance, port)`."""

    instances: list[Instance]
    wires: list[tuple[str, str, str, str]] = field(default_factory=list)


def same(one: Interface, other: Interface) -> bool:
    """Whether two interfaces have the same name, module included."""
    return (one.module, one.name) == (other.module, other.name)


class Names:
    """Names of instances, none twice."""

    def __init__(self) -> None:
        self.taken: set[str] = set()

    def claim(self, wanted: str) -> str:
        """A free name of DDSL for `wanted`."""
        name = re.sub(r"\W", "_", wanted, flags=re.ASCII) or "component"
        name = f"_{name}" if name[0].isdigit() else name
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        return name


def meets(called: Address, listening: Address, other: Instance) -> bool:
    """Whether a call of one address reaches the other; addresses of this machine are all one."""
    if called.port != listening.port or not called.port:
        return False
    hosts = {host_name(listening.host) or host_name(other.host)}
    return host_name(called.host) in hosts | {""} or hosts == {""}


def host_name(host: str) -> str:
    """A host as configurations write it; empty for this machine."""
    return "" if host in HERE or host.startswith("127.") or host == "0.0.0.0" else host  # noqa: S104


def hosts_of(instances: Sequence[Instance]) -> dict[str, tuple[str, str]]:
    """The hosts that are not this machine: address to name and user."""
    found: dict[str, tuple[str, str]] = {}
    names = Names()
    for one in instances:
        address = host_name(one.host)
        if address and address not in found:
            users = [o.user for o in instances if o.host == one.host and o.user]
            found[address] = (names.claim(f"host_{address}"), users[0] if users else "")
    return found


def host_of(one: Instance) -> str:
    """The address of its host; empty for this machine."""
    return host_name(one.host)
