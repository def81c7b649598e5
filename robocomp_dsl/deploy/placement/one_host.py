"""Which components of a deployment must run on the same host. Pure.

Components run on one host if a group says so (it is placed as one, or is one process), or if a
connection between them has no middleware that connects hosts.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.check.ddsl.host_connections import connects_hosts
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.model.deployment import Deployment, External, Instance


def one_host_sets(deployment: Deployment, known: KnownMiddlewares) -> list[list[Instance]]:
    """The instances in disjoint sets, each for one host; sets and members in start order."""
    leader = {instance.name: instance.name for instance in deployment.instances}

    def find(name: str) -> str:
        while leader[name] != name:
            leader[name] = leader[leader[name]]
            name = leader[name]
        return name

    for first, second in _bonds(deployment, known):
        leader[find(second)] = find(first)
    sets: dict[str, list[Instance]] = {}
    for instance in deployment.instances:
        sets.setdefault(find(instance.name), []).append(instance)
    return list(sets.values())


def _bonds(deployment: Deployment, known: KnownMiddlewares) -> Iterator[tuple[str, str]]:
    units: dict[str, str] = {}
    for instance in deployment.instances:
        for unit in (instance.placement.unit, instance.process):
            if unit:
                yield units.setdefault(unit, instance.name), instance.name
    for connection in deployment.connections:
        ends = (connection.source, connection.target)
        if any(isinstance(end, External) for end in ends) or ends[0] is ends[1]:
            continue
        if not connects_hosts(connection, deployment.middleware, known):
            yield ends[0].name, ends[1].name
