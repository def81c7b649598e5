"""Who needs a certificate in a deployment: each component, the router of each host, rcdeploy.

In: a resolved deployment. Out: names, and the addresses of routers. Pure.
"""

from __future__ import annotations

from hashlib import sha256
from ipaddress import ip_address
from typing import Literal

from robocomp_dsl.model.deployment import THIS_MACHINE, UNPLACED, Deployment, Host
from robocomp_dsl.record import ValueRecord

OPERATOR = "rcdeploy"
"""The common name of the operator's certificate."""
LOOPBACK = "127.0.0.1"
_FIRST_PORT = 20000
_PORTS = 10000
"""Below the ports that Linux gives to outgoing connections (32768 to 60999)."""

_MAX_COMMON_NAME = 64
"""Limit of X.509."""

IdentityKind = Literal["component", "router", "operator"]


class Identity(ValueRecord):
    """Who has a certificate. `name` is its common name; a router is reached at `addresses`."""

    name: str
    kind: IdentityKind
    addresses: tuple[str, ...] = ()


def needs_network(deployment: Deployment) -> bool:
    """Whether the deployment is on several hosts, so that it needs keys and routers."""
    return any(not instance.host.is_local for instance in deployment.instances)


def host_name(host: Host) -> str:
    """The name of a host in the DDSL file; `localhost` for this machine."""
    return THIS_MACHINE if host.is_local else host.name


def common_name(name: str) -> str:
    """The common name of a component's certificate: its full name, shortened if X.509 has to."""
    if len(name) <= _MAX_COMMON_NAME:
        return name
    return f"{name[:47]}~{sha256(name.encode()).hexdigest()[:16]}"


def router_name(host: Host) -> str:
    """The common name of the router of a host. No component has a name with a dot."""
    return common_name(f"router.{host_name(host)}")


def used_hosts(deployment: Deployment) -> tuple[Host, ...]:
    """The hosts on which a component or program runs, in order of the file; this machine is last.

    Several names of this machine are one host. If an instance is placed when the deployment starts,
    all hosts of the file count.
    """
    hosts: dict[str, Host] = {}
    placed = [instance.host for instance in deployment.instances if instance.host is not UNPLACED]
    everywhere = len(placed) < len(deployment.instances)
    used = {host_name(host) for host in placed}
    for host in (*deployment.hosts, *placed):
        if everywhere or host_name(host) in used:
            hosts.setdefault(host_name(host), host)
    return tuple(sorted(hosts.values(), key=lambda host: host.is_local))


def router_port(deployment: str, host: Host) -> int:
    """The TCP port of the router: `port` of the host, or a number that follows from the name."""
    digest = sha256(deployment.encode()).digest()
    return host.port or _FIRST_PORT + int.from_bytes(digest[:4]) % _PORTS


def process_names(deployment: Deployment) -> dict[str, str]:
    """The process of each component, by full names: itself, or a group with `inprocess`.

    A process has one certificate.
    """
    groups = {group.name: group.full_name for group in deployment.groups if group.inprocess}
    return {
        instance.full_name: groups.get(instance.process, instance.full_name)
        for instance in deployment.instances
        if not instance.is_program
    }


def identities(deployment: Deployment) -> tuple[Identity, ...]:
    """All who need a certificate, components first."""
    processes = dict.fromkeys(process_names(deployment).values())
    components = (Identity(common_name(name), "component") for name in processes)
    routers = (
        Identity(router_name(host), "router", router_addresses(host))
        for host in used_hosts(deployment)
    )
    return (*components, *routers, Identity(OPERATOR, "operator"))


def router_addresses(host: Host) -> tuple[str, ...]:
    """Where a router listens and what its certificate is for."""
    loopback = (LOOPBACK, THIS_MACHINE)
    return tuple(dict.fromkeys(loopback if host.is_local else (host.address, *loopback)))


def is_ip_address(text: str) -> bool:
    """Whether `text` is an IP address, in contrast to a host name."""
    try:
        ip_address(text)
    except ValueError:
        return False
    return True
