"""Two versions of descriptions compared: what breaks peers, code or configurations.

In: the models of both versions. Out: findings, each of one of the kinds in `codes`; they stand at
the new place, or at the old one where there is none any more. Things are matched by their names
(`Module::Name`, the component's name), so a file may have moved.
"""

from __future__ import annotations

from collections.abc import Iterable
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field

from robocomp_dsl.compare.changes import Changes
from robocomp_dsl.compare.components import compare_components
from robocomp_dsl.compare.interfaces import compare_declarations
from robocomp_dsl.compare.parameters import compare_of_components, compare_sets
from robocomp_dsl.compare.users import Users
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.interface import Module
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.types import Declaration


@dataclass(slots=True)
class Version:
    """The models of one version, by name."""

    declarations: dict[str, Declaration] = field(default_factory=dict)
    components: dict[str, Component] = field(default_factory=dict)
    parameters: dict[str, ParameterSet] = field(default_factory=dict)

    def add(self, model: object) -> None:
        """Take in a model as `check_file` gives it."""
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


def compare(old: Version, new: Version, deployments: Iterable[Deployment], report: Report) -> None:
    """Everything that breaks somebody; `deployments` are those of now that may use it."""
    changes = Changes(report)
    compare_declarations(old.declarations, new.declarations, Users(deployments), report)
    compare_components(old.components, new.components, changes)
    compare_of_components(old.components, new.components, changes)
    # What belongs to a component of both was compared with it, whatever it is called.
    shared = old.components.keys() & new.components.keys()
    compare_sets(_others(old, shared), _others(new, shared), changes)


def _others(version: Version, shared: AbstractSet[str]) -> dict[str, ParameterSet]:
    """The sets of parameters that none of these components uses."""
    used = {
        c.parameters.name for n, c in version.components.items() if n in shared and c.parameters
    }
    return {name: one for name, one in version.parameters.items() if name not in used}
