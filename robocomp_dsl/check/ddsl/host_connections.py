"""Which hosts a connection joins, and whether its middleware connects hosts.

Judged by the capabilities of middlewares. A component without a host yet may run on each of its
candidates.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.model.deployment import UNPLACED, Connection, External, Host, Instance
from robocomp_dsl.model.port_middlewares import shared_middlewares


def needs_hosts_connected(connection: Connection, hosts: Mapping[str, Host]) -> bool:
    """Whether the components of a connection cannot run on the same machine."""
    ends = (connection.source, connection.target)
    if any(isinstance(end, External) for end in ends):
        return False
    first, second = (possible_machines(end, hosts) for end in ends)
    return not first & second


def possible_machines(instance: Instance, hosts: Mapping[str, Host]) -> set[str]:
    """The machines on which an instance may run, as in `Host.machine`."""
    if instance.host is not UNPLACED:
        return {instance.host.machine}
    candidates = instance.placement.candidates
    return {hosts[name].machine if name in hosts else "" for name in candidates}


def connects_hosts(connection: Connection, deployment: str, known: KnownMiddlewares) -> bool:
    """Whether a middleware of the connection connects hosts, or nothing is known of one.

    `deployment` is the middleware of the file, or empty. Also true if its ports share no
    middleware, which another check reports.
    """
    names = shared_middlewares(connection, deployment)
    return not names or any(_connects_hosts(name, known) for name in names)


def _connects_hosts(name: str, known: KnownMiddlewares) -> bool:
    description = known.describe(name)
    return description is None or description.capabilities.between_hosts
