"""Addresses and processes of old, as a deployment: who runs where, who calls whom.

In: the components that moved over, and the processes of a manager's file if there is one. Out: a
`Draft`: instances with their wires, and stand-ins for components that are only known by address.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import PurePosixPath

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.component import Moved, MovedConfig
from robocomp_dsl.migrate.ice import Address
from robocomp_dsl.migrate.manager import Node
from robocomp_dsl.model.component import Component, Role
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span

HERE = ("", "localhost", "*", "::1")
COMMON = "commonbehavior"
"""The end of the interfaces by which RoboComp watched every component."""
FIRST_PORT, LAST_PORT = 1024, 65535


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


def draft(moved: Sequence[Moved], nodes: Sequence[Node], report: Report) -> Draft:
    """The deployment of some processes, or of one of each component where there is no manager."""
    names = _Names()
    if nodes:
        made = [_of_node(one, names.claim(one.name), moved, report) for one in nodes]
        _order(made, nodes, report)
    else:
        made = [_of_component(one, names.claim(one.name)) for one in moved if one.component]
    found = Draft(made)
    for one in list(made):
        _wire(one, found, names, report)
    _give_ports(found.instances)
    return found


class _Names:
    """Names of instances, none twice."""

    def __init__(self) -> None:
        self.taken: set[str] = set()

    def claim(self, wanted: str) -> str:
        name = re.sub(r"\W", "_", wanted, flags=re.ASCII) or "component"
        name = f"_{name}" if name[0].isdigit() else name
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        return name


def _of_component(moved: Moved, name: str) -> Instance:
    config = moved.configs[0] if moved.configs else None
    one = Instance(name, moved.span, moved, config)
    one.listens = list(config.ice.endpoints) if config else []
    return one


def _of_node(node: Node, name: str, moved: Sequence[Moved], report: Report) -> Instance:
    one = Instance(name, node.span, host=node.host, user=node.user)
    if node.address is not None:
        one.listens.append(node.address)
    one.moved = _component_of(node, moved)
    if one.moved is not None:
        one.config = _config_of(node, one.moved, report)
        one.listens += one.config.ice.endpoints if one.config else ()
    if node.command:
        said = f"`{node.name}` was started with `{node.command:.200}`"
        report.add(codes.COMMAND, node.span, said)
        one.remarks.append(f"was started with: {node.command}")
    return one


def _component_of(node: Node, moved: Sequence[Moved]) -> Moved | None:
    """The component of a process, by its folder, its program, its name; the surest first."""
    words = [re.split(r"[/\\]", word)[-1] for word in node.command.split()]
    programs = {re.sub(r"\.py$", "", word).lower() for word in words}
    for wanted in ({node.folder.name.lower()}, programs, {node.name.lower()}):
        for one in moved:
            if wanted & {one.folder.name.lower(), one.name.lower()}:
                return one
    return None


def _config_of(node: Node, moved: Moved, report: Report) -> MovedConfig | None:
    if node.config is None:
        return moved.configs[0] if moved.configs else None
    for one in moved.configs:
        if one.old.name == node.config.name:
            return one
    said = f"`{node.name}` had the configuration `{node.config}`, which {moved.name} does not have"
    report.add(codes.MANAGER_SETTING, node.span, said)
    return moved.configs[0] if moved.configs else None


def _order(made: Sequence[Instance], nodes: Sequence[Node], report: Report) -> None:
    """Fill `after`; what names nobody or closes a circle is left out."""
    by_name = {node.name: one for node, one in zip(nodes, made, strict=True)}
    for node, one in zip(nodes, made, strict=True):
        for name, span in node.after:
            other = by_name.get(name)
            if other is None:
                said = f"`{node.name}` depends on `{name}`, which is not in the deployment"
                report.add(codes.DEPENDENCE_DROPPED, span, said)
            elif one.name in _before(other, made):
                said = f"`{node.name}` depends on `{name}`, which waits for `{node.name}` itself"
                report.add(codes.DEPENDENCE_DROPPED, span, said)
            elif other.name not in one.after:
                one.after.append(other.name)


def _before(one: Instance, made: Sequence[Instance]) -> set[str]:
    """The names of `one` and of everything that it waits for."""
    by_name = {other.name: other for other in made}
    found, pending = {one.name}, [one]
    while pending:
        for name in pending.pop().after:
            if name not in found:
                found.add(name)
                pending.append(by_name[name])
    return found


def _wire(one: Instance, found: Draft, names: _Names, report: Report) -> None:
    """Connect what an instance requires, by the addresses of its configuration."""
    if one.component is None:
        return
    addresses = {a.name.lower(): a for a in (one.config.ice.proxies if one.config else ())}
    used = set()
    for port in one.component.with_role(Role.REQUIRES):
        key = _key(port.name, port.interface, addresses)
        used.add(key)
        server = _server(one, port.interface, addresses.get(key), found.instances)
        if server is None:
            server = _stand_in(port.interface, addresses.get(key), one, found, names, report)
        target = server.serves(port.interface)
        if target is not None:
            found.wires.append((one.name, port.name, server.name, target))
    for key, address in addresses.items():
        if key not in used:
            said = f"`{one.component.name}` has no port for the proxy `{address.name}`"
            report.add(codes.UNKNOWN_PROXY, address.span, said)


def _key(port: str, interface: Interface, addresses: dict[str, Address]) -> str:
    """The key of a port's address: its name, that of its interface, or that with a number."""
    number = re.sub(r".*?(\d*)$", r"\1", port) if port.startswith(interface.name) else ""
    wanted = [port, f"{interface.name}{int(number or 0) - 1}" if number else f"{interface.name}0"]
    wanted += [interface.name] if not number else []
    return next((w.lower() for w in wanted if w.lower() in addresses), port.lower())


def _server(
    one: Instance, interface: Interface, address: Address | None, instances: Sequence[Instance]
) -> Instance | None:
    """Who serves `interface` there; without an address, or where nobody listens, the only one."""
    serving = [other for other in instances if other is not one and other.serves(interface)]
    if address is not None:
        at = [other for other in serving if any(_meets(address, a, other) for a in other.listens)]
        if at:
            return at[0]
        if any(_meets(address, a, o) for o in instances for a in o.listens if not o.component):
            return None
    return serving[0] if len(serving) == 1 and not serving[0].peer else None


def _meets(called: Address, listening: Address, other: Instance) -> bool:
    """Whether a call of one address reaches the other; addresses of this machine are all one."""
    if called.port != listening.port or not called.port:
        return False
    hosts = {_host(listening.host) or _host(other.host)}
    return _host(called.host) in hosts | {""} or hosts == {""}


def _host(host: str) -> str:
    return "" if host in HERE or host.startswith("127.") or host == "0.0.0.0" else host  # noqa: S104


def _stand_in(
    interface: Interface,
    address: Address | None,
    one: Instance,
    found: Draft,
    names: _Names,
    report: Report,
) -> Instance:
    """A stand-in that serves `interface` there; one that is known by its address only, or new."""
    span = address.span if address else one.span
    for other in found.instances:
        known = address and any(_meets(address, a, other) for a in other.listens)
        if known and other.component is None:
            other.peer.append(interface)
            return other
    named = address.identity if address and re.fullmatch(r"\w+", address.identity) else ""
    made = Instance(names.claim(named or interface.name.lower()), span, peer=[interface])
    if address is not None:
        made.listens, made.host = [address], _host(address.host)
    found.instances.append(made)
    said = f"`{made.name}` stands for the component that serves {interface.name} to `{one.name}`"
    report.add(codes.STAND_IN, span, said)
    return made


def _give_ports(instances: Sequence[Instance]) -> None:
    """The TCP port of each instance: the first of its addresses that is free on its host."""
    taken: set[tuple[str, int]] = set()
    for one in instances:
        listed = [a for a in one.listens if not a.name.lower().endswith(COMMON)]
        listed = [a for a in listed if not a.identity.lower().endswith(COMMON)]
        for address in listed:
            key = (_host(one.host), address.port)
            if FIRST_PORT <= address.port <= LAST_PORT and key not in taken and not one.port:
                taken.add(key)
                one.port = address.port
        rest = [a for a in listed if a.port and a.port != one.port]
        words = (f"{a.port} for {a.name}" if a.name else str(a.port) for a in rest)
        one.remarks += [f"listened on port {said}, too" for said in dict.fromkeys(words)]


def by_identity(name: str, known: Iterator[Interface]) -> Interface | None:
    """The interface whose name in lower case is the identity that Ice knew it by."""
    return next((one for one in known if one.name.lower() == name.lower()), None)


def hosts_of(instances: Sequence[Instance]) -> dict[str, tuple[str, str]]:
    """The hosts that are not this machine: address to name and user."""
    found: dict[str, tuple[str, str]] = {}
    names = _Names()
    for one in instances:
        address = _host(one.host)
        if address and address not in found:
            users = [o.user for o in instances if o.host == one.host and o.user]
            found[address] = (names.claim(f"host_{address}"), users[0] if users else "")
    return found


def host_of(one: Instance) -> str:
    """The address of its host; empty for this machine."""
    return _host(one.host)


def relative(path: str, below: str) -> str:
    """A path in the folder of a component, from the folder of the deployment."""
    return str(PurePosixPath(below) / path) if below else path
