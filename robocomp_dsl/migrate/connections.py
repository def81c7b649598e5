"""Connect instances by the addresses of their configurations.

In: the instances of a deployment. Out: connections, and stand-ins for unknown addresses.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.ice import Address
from robocomp_dsl.migrate.instances import (
    DeploymentDraft,
    InstanceNames,
    MigratedInstance,
    address_matches,
    host_name,
)
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.interface import Interface


def connect_instance(
    instance: MigratedInstance, draft: DeploymentDraft, names: InstanceNames, report: Report
) -> None:
    """Connect the required ports of an instance, by the addresses of its configuration."""
    if instance.component is None:
        return
    addresses = {
        a.name.lower(): a for a in (instance.config.ice.proxies if instance.config else ())
    }
    used = set()
    for port in instance.component.with_role(Role.REQUIRES):
        key = _address_key(port.name, port.interface, addresses)
        used.add(key)
        server = _find_server(
            instance, port.name, port.interface, addresses.get(key), draft.instances
        )
        if server is None:
            server = _add_stand_in(
                port.interface, addresses.get(key), instance, draft, names, report
            )
        target = server.serves(port.interface)
        if target is not None:
            draft.connections.append((instance.name, port.name, server.name, target))
    for key, address in addresses.items():
        if key not in used:
            message = f"`{instance.component.name}` has no port for the proxy `{address.name}`"
            report.add(codes.UNKNOWN_PROXY, address.span, message)


def _address_key(port: str, interface: Interface, addresses: dict[str, Address]) -> str:
    """The key of a port's address: the port's name or the interface's, maybe with a number."""
    number = re.sub(r".*?(\d*)$", r"\1", port) if port.startswith(interface.name) else ""
    candidates = [
        port,
        f"{interface.name}{int(number or 0) - 1}" if number else f"{interface.name}0",
    ]
    candidates += [interface.name] if not number else []
    return next((w.lower() for w in candidates if w.lower() in addresses), port.lower())


def _find_server(
    client: MigratedInstance,
    port: str,
    interface: Interface,
    address: Address | None,
    instances: Sequence[MigratedInstance],
) -> MigratedInstance | None:
    """The instance that serves `interface` at `address`; None if there is none.

    Without an address, or if no instance listens there, it is the only server of `interface`, or
    the one that is named like the port; with an address, other instances of the client's own
    component are excluded.
    """
    serving = [other for other in instances if other is not client and other.serves(interface)]
    aliases = {port.lower(), interface.name.lower()}
    if address is not None:
        aliases = {address.identity.lower()} if address.identity else aliases
        listening = [
            other
            for other in serving
            if any(address_matches(address, a, other) for a in other.endpoints)
        ]
        if listening:
            return _with_alias(listening, aliases) or listening[0]
        if any(
            address_matches(address, a, o)
            for o in instances
            for a in o.endpoints
            if not o.component
        ):
            return None
        serving = [other for other in serving if other.component is not client.component]
    real = [other for other in serving if not other.peer_interfaces]
    return real[0] if len(real) == 1 and len(serving) == 1 else _with_alias(real, aliases)


def _with_alias(
    instances: Sequence[MigratedInstance], aliases: Collection[str]
) -> MigratedInstance | None:
    """The only instance with one of these names; None if there is none, or several."""
    found = [other for other in instances if other.name.lower() in aliases]
    return found[0] if len(found) == 1 else None


def _add_stand_in(
    interface: Interface,
    address: Address | None,
    client: MigratedInstance,
    draft: DeploymentDraft,
    names: InstanceNames,
    report: Report,
) -> MigratedInstance:
    """Add `interface` to the stand-in at `address`, or add a new stand-in."""
    span = address.span if address else client.span
    known = _known_stand_in(interface, address, client, draft)
    if known is not None:
        if not known.stands_in_for(interface):
            known.peer_interfaces.append(interface)
        return known
    named = address.identity if address and re.fullmatch(r"\w+", address.identity) else ""
    stand_in = MigratedInstance(
        names.claim_stand_in(named or interface.name.lower()), span, peer_interfaces=[interface]
    )
    if address is not None:
        stand_in.endpoints, stand_in.host = [address], host_name(address.host)
    draft.instances.append(stand_in)
    message = (
        f"`{stand_in.name}` is a stand-in for the component that serves "
        f"{interface.name} to `{client.name}`"
    )
    report.add(codes.STAND_IN, span, message)
    return stand_in


def _known_stand_in(
    interface: Interface,
    address: Address | None,
    client: MigratedInstance,
    draft: DeploymentDraft,
) -> MigratedInstance | None:
    """The stand-in at an address; else the one for the same object that this client does not call.

    Addresses in old configurations are often stale: several components name the same object with
    different ports. Two addresses in one configuration are two objects.
    """
    stand_ins = [other for other in draft.instances if other.component is None]
    for other in stand_ins:
        if address and any(address_matches(address, a, other) for a in other.endpoints):
            return other
    called = {server for caller, _, server, _ in draft.connections if caller == client.name}
    identities = {interface.name.lower()}
    if address and address.identity:
        identities.add(address.identity.lower())
    for other in stand_ins:
        known = {a.identity.lower() for a in other.endpoints} | {other.name.lower()}
        if known & identities and other.name not in called:
            return other
    return None
