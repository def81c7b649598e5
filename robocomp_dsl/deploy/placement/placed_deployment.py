"""A deployment whose instances have other hosts. Pure."""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.model.deployment import Deployment, Host, Instance


def with_hosts(deployment: Deployment, hosts: Mapping[str, Host]) -> Deployment:
    """`deployment` with the hosts of some instances, by name, replaced everywhere."""
    return with_instances(
        deployment,
        {
            instance.name: instance.replace(host=hosts[instance.name])
            for instance in deployment.instances
            if instance.name in hosts
        },
    )


def with_instances(deployment: Deployment, changed: Mapping[str, Instance]) -> Deployment:
    """`deployment` with some instances, by name, replaced everywhere."""
    placed = {i.name: changed.get(i.name, i) for i in deployment.instances}
    ends: dict[str, Instance] = {**{e.name: e for e in deployment.externals}, **placed}
    clock = deployment.clock
    return deployment.replace(
        instances=tuple(placed.values()),
        connections=tuple(
            connection.replace(
                source=ends[connection.source.name], target=ends[connection.target.name]
            )
            for connection in deployment.connections
        ),
        groups=tuple(
            group.replace(
                exports=tuple(
                    export.replace(instance=placed[export.instance.name])
                    if export.instance.name in placed
                    else export
                    for export in group.exports
                )
            )
            for group in deployment.groups
        ),
        clock=clock.replace(source=placed[clock.source.name]) if clock.source else clock,
    )
