"""What is documented.

In: models, as the checks give them. Out: the same, sorted, with everything behind them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine


@dataclass(frozen=True, slots=True)
class Subject:
    """Everything that gets a page, each sort in the order of names.

    `parameters` and `machines` are those that no component here names. A component that several
    deployments import was read once for each: `same` leads from each to the one in `components`.
    """

    title: str
    modules: tuple[Module, ...] = ()
    components: tuple[Component, ...] = ()
    deployments: tuple[Deployment, ...] = ()
    parameters: tuple[ParameterSet, ...] = ()
    machines: tuple[StateMachine, ...] = ()
    same: Mapping[int, Component] = field(default_factory=dict)


def natural(name: str) -> tuple[list[tuple[int, str]], str]:
    """What names are sorted by: whatever the case, and 9 before 10."""
    parts = re.findall(r"[0-9]+|[^0-9]+", name.lower())
    numbers = [(len(part.lstrip("0")), part.lstrip("0")) for part in parts]
    keys = zip(parts, numbers, strict=True)
    return [number if part.isdecimal() else (-1, part) for part, number in keys], name


def modules_behind(modules: Iterable[Module]) -> tuple[Module, ...]:
    """These modules and all that they import, in the order of names; copies of a file, too."""
    found = {id(one): one for module in modules for one in module.closure()}
    return tuple(sorted(found.values(), key=lambda m: (natural(m.name), str(m.path))))
