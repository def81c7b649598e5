"""Selects one group of a deployment as a deployment. Pure.

In: a deployment and the name of a group. Out: a deployment with the components of that group, the
connections between them, and the start order among them. Components outside the group are found in
the domain if they run there.
"""

from __future__ import annotations

from robocomp_dsl.model.deployment import Connection, Deployment


class NoSuchGroup(Exception):
    """The deployment has no group of that name; the message lists its groups."""


def select_group(deployment: Deployment, name: str) -> Deployment:
    """The deployment of the group `name` (`arm`, or `arm-hand` for a nested group).

    Raises `NoSuchGroup`.
    """
    group = next((group for group in deployment.groups if group.name == name), None)
    if group is None:
        known = ", ".join(group.name for group in deployment.groups) or "none"
        raise NoSuchGroup(f"`{deployment.name}` has no group `{name}`; its groups: {known}")
    clock = deployment.clock
    inside = set(group.instances)
    selected = {
        instance.name: instance.replace(after=tuple(n for n in instance.after if n in inside))
        for instance in deployment.instances
        if instance.name in inside
    }
    return deployment.replace(
        instances=tuple(selected.values()),
        connections=tuple(
            wire.replace(source=selected[wire.source.name], target=selected[wire.target.name])
            for wire in deployment.connections
            if _is_internal(wire, inside)
        ),
        # Without the source of the time a group lives by the clock of the machine.
        clock=clock.replace(source=selected.get(clock.source.name)) if clock.source else clock,
    )


def _is_internal(wire: Connection, inside: set[str]) -> bool:
    return wire.source.name in inside and wire.target.name in inside
