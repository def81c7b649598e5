"""A group in a plan: what it is an instance of, and which ports it has for others. Pure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.model.deployment import Deployment


@dataclass(frozen=True, slots=True)
class PlannedGroup:
    """A group; `exports` are its ports, each with the port of a component that it stands for."""

    name: str
    definition: str
    inprocess: bool
    exports: tuple[tuple[str, str], ...]

    def format(self) -> Iterator[str]:
        """The group and its ports as text lines."""
        kind = f" : {self.definition}" if self.definition else ""
        process = ", one process" if self.inprocess else ""
        yield f"group {self.name}{kind}{process}"
        for port, target in self.exports:
            yield f"   {port} is {target}"

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "name": self.name,
            "definition": self.definition,
            "inprocess": self.inprocess,
            "exports": dict(self.exports),
        }


def planned_groups(deployment: Deployment) -> tuple[PlannedGroup, ...]:
    """The groups of a deployment, outer groups first."""
    present = {instance.name for instance in deployment.instances}
    return tuple(
        PlannedGroup(
            group.full_name,
            group.definition,
            group.inprocess,
            tuple((e.name, f"{e.instance.full_name}.{e.port.name}") for e in group.exports),
        )
        for group in deployment.groups
        if present.intersection(group.instances)
    )
