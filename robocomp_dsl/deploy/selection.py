"""One group of a deployment as a deployment of its own. Pure.

In: a deployment and the name of a group. Out: the deployment with what is in that group alone: the
wires inside of it, and what its components wait for there. What they use elsewhere, they find in
the domain, if it runs there.
"""

from __future__ import annotations

from robocomp_dsl.model.deployment import Connection, Deployment


class NoSuchGroup(Exception):
    """The deployment has no group of that name; the message says which it has."""


def only(deployment: Deployment, name: str) -> Deployment:
    """What is in the group called `name` (`arm`, or `arm-hand` inside of it).

    Raises `NoSuchGroup`.
    """
    group = next((one for one in deployment.groups if one.name == name), None)
    if group is None:
        known = ", ".join(one.name for one in deployment.groups) or "none"
        raise NoSuchGroup(f"`{deployment.name}` has no group `{name}`; it has {known}")
    clock = deployment.clock
    inside = set(group.instances)
    made = {
        one.name: one.replaced(after=tuple(n for n in one.after if n in inside))
        for one in deployment.instances
        if one.name in inside
    }
    return deployment.replaced(
        instances=tuple(made.values()),
        connections=tuple(
            wire.replaced(source=made[wire.source.name], target=made[wire.target.name])
            for wire in deployment.connections
            if _is_within(wire, inside)
        ),
        # Without the source of the time a group lives by the clock of the machine.
        clock=clock.replaced(source=made.get(clock.source.name)) if clock.source else clock,
    )


def _is_within(wire: Connection, inside: set[str]) -> bool:
    return wire.source.name in inside and wire.target.name in inside
