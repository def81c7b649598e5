"""Loads the subject of `rcgen doc`. In: files. Out: a `DocumentationSubject`, and findings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TypeVar

from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.doc.subject import (
    DocumentationSubject,
    natural_sort_key,
    transitive_modules,
)
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine

_Noun = TypeVar("_Noun", Bridge, Component, Deployment, ParameterSet, StateMachine)


def read_subject(
    paths: Sequence[Path],
    title: str,
    workspace: Workspace,
    report: Report,
    left_out: list[Path] | None = None,
) -> DocumentationSubject:
    """The models of the files and of everything that they use, without duplicates.

    Files with errors are left out and added to `left_out`; `report` gets all findings.
    """
    models = []
    for path in paths:
        own = Report()
        model = check_file(path, workspace, own)
        report.extend(own)
        if not own.has_errors:
            models.append(model)
        elif left_out is not None:
            left_out.append(path)
    deployments = _unique(model for model in models if isinstance(model, Deployment))
    seen = [model for model in models if isinstance(model, Component)]
    parts = [part for deployment in deployments for part in deployment.instances]
    seen += [part.component for part in parts if not part.is_program]
    components = _unique(seen)
    by_file = {canonical_path(component.path): component for component in components}
    named = {
        canonical_path(component.parameters.path)
        for component in components
        if component.parameters
    }
    machines = (
        component.statemachine.machine for component in components if component.statemachine
    )
    named |= {canonical_path(model.path) for model in machines if model}
    modules = [m for model in models if isinstance(model, tuple) for m in model]
    modules += [m for model in seen for m in model.modules]
    bridges = _unique(model for model in models if isinstance(model, Bridge))
    modules += [m for bridge in bridges for m in bridge.modules]
    modules += [bridge.types for bridge in bridges if bridge.types]
    alone = [model for model in models if isinstance(model, ParameterSet | StateMachine)]
    alone = [model for model in alone if canonical_path(model.path) not in named]
    return DocumentationSubject(
        title,
        modules=transitive_modules(modules),
        components=components,
        deployments=deployments,
        parameters=_unique(model for model in alone if isinstance(model, ParameterSet)),
        machines=_unique(model for model in alone if isinstance(model, StateMachine)),
        bridges=bridges,
        canonical_components={id(model): by_file[canonical_path(model.path)] for model in seen},
    )


def _unique(models: Iterable[_Noun]) -> tuple[_Noun, ...]:
    """One model per file, sorted by name."""
    unique: dict[str, _Noun] = {}
    for model in models:
        unique.setdefault(canonical_path(model.path), model)
    return tuple(sorted(unique.values(), key=lambda m: (natural_sort_key(m.name), str(m.path))))
