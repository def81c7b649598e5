"""Compares two versions of descriptions and reports breaking changes.

In: the models of both versions. Out: findings with the codes in `codes`, at the new location, or at
the old one for a removed declaration. Declarations are matched by name (`Module::Name`, the name of
the component), so files may move.
"""

from __future__ import annotations

from collections.abc import Iterable
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field

from robocomp_dsl.breaking.changes import Changes
from robocomp_dsl.breaking.components import compare_components
from robocomp_dsl.breaking.interfaces import compare_declarations
from robocomp_dsl.breaking.parameters import compare_of_components, compare_sets
from robocomp_dsl.breaking.users import Users
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.types import Declaration


@dataclass(slots=True)
class Version:
    """The models of one version, by name. `ros` are the structs of imported ROS definitions."""

    declarations: dict[str, Declaration] = field(default_factory=dict)
    ros: dict[str, Declaration] = field(default_factory=dict)
    components: dict[str, Component] = field(default_factory=dict)
    parameters: dict[str, ParameterSet] = field(default_factory=dict)

    def add(self, model: object) -> None:
        """Add a model that `check_file` returned."""
        match model:
            case Component():
                self.components[model.name] = model
            case ParameterSet():
                self.parameters[model.name] = model
            case tuple():
                for module in model:
                    self.add(module)
            case Module():
                self.declarations |= {d.qualified: d for d in model.declarations}
                definitions = (m for m in model.closure() if m.origin and m is not model)
                self.ros |= {d.qualified: d for m in definitions for d in m.declarations}


def compare(old: Version, new: Version, deployments: Iterable[Deployment], report: Report) -> None:
    """Report all breaking changes; `deployments` are those that may be affected."""
    changes = Changes(report)
    # A definition that is no longer imported matters only to operations, which are compared.
    ros = old.ros.keys() & new.ros.keys()
    compare_declarations(
        old.declarations | {name: old.ros[name] for name in ros},
        new.declarations | {name: new.ros[name] for name in ros},
        Users(deployments),
        report,
    )
    compare_components(old.components, new.components, changes)
    compare_of_components(old.components, new.components, changes)
    # The parameter sets of components in both versions are already compared.
    shared = old.components.keys() & new.components.keys()
    compare_sets(_others(old, shared), _others(new, shared), changes)


def _others(version: Version, shared: AbstractSet[str]) -> dict[str, ParameterSet]:
    """The parameter sets that none of these components uses."""
    used = {
        c.parameters.name for n, c in version.components.items() if n in shared and c.parameters
    }
    return {name: parameter for name, parameter in version.parameters.items() if name not in used}
