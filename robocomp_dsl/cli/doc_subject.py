"""What `rcgen doc` documents. In: files. Out: a `Subject`, and findings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TypeVar

from robocomp_dsl.check import check_file
from robocomp_dsl.check.files import identity
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.doc.subject import Subject, modules_behind, natural
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine

_Noun = TypeVar("_Noun", Component, Deployment, ParameterSet, StateMachine)


def read_subject(
    paths: Sequence[Path], title: str, workspace: Workspace, report: Report
) -> Subject:
    """Everything in the files and behind them; what is in two of them is there once."""
    models = [check_file(path, workspace, report) for path in paths]
    deployments = _once(one for one in models if isinstance(one, Deployment))
    seen = [one for one in models if isinstance(one, Component)]
    seen += [part.component for one in deployments for part in one.instances]
    components = _once(seen)
    by_file = {identity(one.path): one for one in components}
    named = {identity(one.parameters.path) for one in components if one.parameters}
    behind = (one.statemachine.machine for one in components if one.statemachine)
    named |= {identity(one.path) for one in behind if one}
    modules = [m for one in models if isinstance(one, tuple) for m in one]
    modules += [m for one in seen for m in one.modules]
    alone = [one for one in models if isinstance(one, ParameterSet | StateMachine)]
    alone = [one for one in alone if identity(one.path) not in named]
    return Subject(
        title,
        modules=modules_behind(modules),
        components=components,
        deployments=deployments,
        parameters=_once(one for one in alone if isinstance(one, ParameterSet)),
        machines=_once(one for one in alone if isinstance(one, StateMachine)),
        same={id(one): by_file[identity(one.path)] for one in seen},
    )


def _once(models: Iterable[_Noun]) -> tuple[_Noun, ...]:
    """One of each file, in the order of names."""
    kept: dict[str, _Noun] = {}
    for one in models:
        kept.setdefault(identity(one.path), one)
    return tuple(sorted(kept.values(), key=lambda m: (natural(m.name), str(m.path))))
