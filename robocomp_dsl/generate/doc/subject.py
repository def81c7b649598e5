"""The subject of a documentation.

In: checked models. Out: the models in sorted order, with all imports.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine


@dataclass(frozen=True, slots=True)
class DocumentationSubject:
    """All models that get a page, sorted by name.

    `parameters` and `machines` are those without a component. A component that several
    deployments import is read once for each: `canonical_components` maps the identity of each copy
    to the one in `components`.
    """

    title: str
    modules: tuple[Module, ...] = ()
    components: tuple[Component, ...] = ()
    deployments: tuple[Deployment, ...] = ()
    parameters: tuple[ParameterSet, ...] = ()
    machines: tuple[StateMachine, ...] = ()
    bridges: tuple[Bridge, ...] = ()
    canonical_components: Mapping[int, Component] = field(default_factory=dict)


def natural_sort_key(name: str) -> tuple[list[tuple[int, str]], str]:
    """Sort key of a name: regardless of case, and 9 before 10."""
    parts = re.findall(r"[0-9]+|[^0-9]+", name.lower())
    numbers = [(len(part.lstrip("0")), part.lstrip("0")) for part in parts]
    keys = zip(parts, numbers, strict=True)
    return [number if part.isdecimal() else (-1, part) for part, number in keys], name


def transitive_modules(modules: Iterable[Module]) -> tuple[Module, ...]:
    """These modules and all their imports, sorted by name, including copies of files."""
    by_identity = {id(imported): imported for module in modules for imported in module.closure()}
    return tuple(
        sorted(by_identity.values(), key=lambda m: (natural_sort_key(m.name), str(m.path)))
    )
