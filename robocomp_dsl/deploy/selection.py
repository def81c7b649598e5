"""Selects parts of a deployment by name. Pure.

In: a deployment and the name of a group. Out: a deployment with the components of that group, the
connections between them, and the start order among them. Components outside the group are found in
the domain if they run there. Or, in: processes and names as a user types them; out: full names.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.model.deployment import Deployment, Instance


class NoSuchGroup(Exception):
    """The deployment has no group of that name; the message lists its groups."""


class NoSuchComponent(Exception):
    """There is no component or group of that name; the message lists what there is."""


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
    externals = {external.name: external for external in deployment.externals}
    ends: dict[str, Instance] = {**externals, **selected}
    connections = tuple(
        wire.replace(source=ends[wire.source.name], target=ends[wire.target.name])
        for wire in deployment.connections
        if wire.source.name in ends and wire.target.name in ends
    )
    used = {end.name for wire in connections for end in (wire.source, wire.target)}
    return deployment.replace(
        instances=tuple(selected.values()),
        connections=connections,
        externals=tuple(external for external in deployment.externals if external.name in used),
        # Without the source of the time a group lives by the clock of the machine.
        clock=clock.replace(source=selected.get(clock.source.name)) if clock.source else clock,
    )


class Selectable(Protocol):
    """A component or program with its full name, and the group that it is in."""

    @property
    def name(self) -> str:
        """Its full name."""

    @property
    def group(self) -> str:
        """The group, empty for none."""

    @property
    def member_names(self) -> tuple[str, ...]:
        """The components that run in it, if it is the process of a group."""


def select_names(names: Iterable[str], processes: Sequence[Selectable]) -> list[str]:
    """The full names of components and of all members of groups, in the order of `processes`.

    A component may be named without its prefix. Raises `NoSuchComponent`.
    """
    selected: set[str] = set()
    for name in names:
        exact = [p.name for p in processes if p.name == name]
        short = [p.name for p in processes if p.name.rpartition("/")[2] == name]
        group = [p.name for p in processes if p.group == name or p.group.startswith(f"{name}-")]
        owner = next((p for p in processes if _has_member(p, name)), None)
        if owner and not (exact or short or group):
            raise NoSuchComponent(
                f"`{name}` runs in the process of the group `{owner.name}`; name the group"
            )
        if not exact and len(short) > 1:
            raise NoSuchComponent(f"`{name}` is ambiguous: {', '.join(short)}")
        found = exact or short or group
        if not found:
            raise NoSuchComponent(_unknown(name, processes))
        selected.update(found)
    return [p.name for p in processes if p.name in selected]


def _has_member(process: Selectable, name: str) -> bool:
    """Whether a component of that name, with or without its prefix, runs in the process."""
    return any(name in (member, member.rpartition("/")[2]) for member in process.member_names)


def _unknown(name: str, processes: Sequence[Selectable]) -> str:
    components = [p.name for p in processes]
    groups = list(dict.fromkeys(p.group for p in processes if p.group))
    hint = did_you_mean(name, components + groups) or f"it has {', '.join(components + groups)}"
    return f"there is no component or group `{name}` in the deployment; {hint}"
