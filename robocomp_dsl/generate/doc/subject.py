"""What is documented.

In: models, as the checks give them. Out: the same, sorted, with everything behind them.
"""

from __future__ import annotations

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

    `machines` has the state machine of a component, by the component's identity; `parameters` and
    `lone_machines` are those that no component here names. A component that several deployments
    import was read once for each: `same` leads from each of them to the one in `components`.
    """

    title: str
    modules: tuple[Module, ...] = ()
    components: tuple[Component, ...] = ()
    deployments: tuple[Deployment, ...] = ()
    parameters: tuple[ParameterSet, ...] = ()
    lone_machines: tuple[StateMachine, ...] = ()
    machines: Mapping[int, StateMachine] = field(default_factory=dict)
    same: Mapping[int, Component] = field(default_factory=dict)


def modules_behind(modules: Iterable[Module]) -> tuple[Module, ...]:
    """These modules and all that they import, in the order of names; copies of a file, too."""
    found = {id(one): one for module in modules for one in module.closure()}
    return tuple(sorted(found.values(), key=lambda m: (m.name.lower(), m.name, str(m.path))))
