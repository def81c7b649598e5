"""Who calls whom: what components require, by the addresses of their configurations.

In: the instances of a deployment. Out: wires in it, and stand-ins for what is only an address.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.ice import Address
from robocomp_dsl.migrate.instances import Draft, Instance, Names, host_name, meets
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.interface import Interface


def wire(one: Instance, found: Draft, names: Names, report: Report) -> None:
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
    """Who serves `interface` there; without an address, or where nobody listens, the only one.

    One that is like itself and listens elsewhere is not meant by an address.
    """
    serving = [other for other in instances if other is not one and other.serves(interface)]
    if address is not None:
        at = [other for other in serving if any(meets(address, a, other) for a in other.listens)]
        if at:
            return at[0]
        if any(meets(address, a, o) for o in instances for a in o.listens if not o.component):
            return None
        serving = [other for other in serving if other.component is not one.component]
    return serving[0] if len(serving) == 1 and not serving[0].peer else None


def _stand_in(
    interface: Interface,
    address: Address | None,
    one: Instance,
    found: Draft,
    names: Names,
    report: Report,
) -> Instance:
    """A stand-in that serves `interface` there; one that is known by its address only, or new."""
    span = address.span if address else one.span
    for other in found.instances:
        known = address and any(meets(address, a, other) for a in other.listens)
        if known and other.component is None:
            other.peer.append(interface)
            return other
    named = address.identity if address and re.fullmatch(r"\w+", address.identity) else ""
    made = Instance(names.claim(named or interface.name.lower()), span, peer=[interface])
    if address is not None:
        made.listens, made.host = [address], host_name(address.host)
    found.instances.append(made)
    said = f"`{made.name}` stands for the component that serves {interface.name} to `{one.name}`"
    report.add(codes.STAND_IN, span, said)
    return made
