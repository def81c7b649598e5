"""The part of `rcgen breaking` that is about deployments: which of them do not work any more.

In: a DDSL file as it is, where it would be in the earlier version, the folders of both. Out: what
is wrong with it now and was not with the components of then, and what was wrong with it anyway.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check import check_ddsl
from robocomp_dsl.check import codes as checks
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.compare import codes
from robocomp_dsl.deploy import codes as running
from robocomp_dsl.deploy.plan import Process, plan
from robocomp_dsl.deploy.preflight import configuration
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment

_VALUES = frozenset(
    (checks.UNKNOWN_SETTING, checks.SETTING_TYPE, checks.SETTING_RANGE, running.CONFIGURATION)
)
_UNSEEN = frozenset((checks.MISSING_IMPORT, checks.UNREADABLE_IMPORT))


@dataclass(slots=True)
class Judged:
    """`broken`: findings of kind wiring and values; `own`: the file itself is wrong."""

    broken: list[Diagnostic] = field(default_factory=list)
    own: list[Diagnostic] = field(default_factory=list)
    deployment: Deployment | None = None


def judge(path: Path, then: Path | None, new: Iterable[Path], old: Iterable[Path]) -> Judged:
    """The deployment at `path`; `then` is its place in the earlier version, if it has one there.

    `new` and `old` are the folders of interfaces of now and of then.
    """
    now, deployment = _checked(path, Workspace(new))
    made = Judged(deployment=deployment)
    before, earlier = _with_earlier(path, then, old) if then else ([], None)
    known = {_same(one) for one in before}
    comparable = earlier is not None and not any(one.code in _UNSEEN for one in before)
    for one in now:
        if comparable and _same(one) not in known:
            made.broken.append(_broken(one, deployment or earlier))
        elif one.severity is Severity.ERROR:
            made.own.append(one)
    if deployment and earlier and comparable:
        made.broken += _values(deployment, earlier)
    return made


def _checked(path: Path, workspace: Workspace) -> tuple[list[Diagnostic], Deployment | None]:
    """What is wrong at the places of the file itself."""
    report = Report()
    deployment = check_ddsl(path, workspace, report)
    found = [one for one in report if one.span.source.path == path]
    wrong = [one for one in found if one.severity is Severity.ERROR]
    return [*wrong, *(one for one in found if one.code is checks.NO_PUBLISHER)], deployment


def _with_earlier(
    path: Path, then: Path, old: Iterable[Path]
) -> tuple[list[Diagnostic], Deployment | None]:
    """The text of now among the descriptions of then."""
    workspace = Workspace(old)
    workspace.files.open_buffer(then, workspace.files.read(path).text)
    return _checked(then, workspace)


def _same(one: Diagnostic) -> tuple[str, int, int, str]:
    return (one.code.id, one.span.start, one.span.end, one.message)


def _broken(one: Diagnostic, deployment: Deployment | None) -> Diagnostic:
    code = codes.VALUES if one.code in _VALUES else codes.WIRING
    return _of(deployment, one.replaced(code=code, fix=None))


def _of(deployment: Deployment | None, one: Diagnostic) -> Diagnostic:
    name = f"deployment `{deployment.name}`: " if deployment else ""
    return one.replaced(message=f"{name}{one.message}")


def _values(deployment: Deployment, earlier: Deployment) -> Iterator[Diagnostic]:
    """What the components of now refuse of their configurations, and those of then took."""
    was = {one.name: one.component for one in earlier.instances}
    processes = plan(deployment, name="", domain="", interpreter="python3").processes
    before = _refused(deployment, processes, was)
    for place, found in _refused(deployment, processes, {}).items():
        if place not in before:
            yield _of(deployment, found.replaced(code=codes.VALUES))


def _refused(
    deployment: Deployment, processes: Iterable[Process], instead: Mapping[str, Component]
) -> dict[tuple[str, int, int, str], Diagnostic]:
    """What is wrong with values; the components of some instances are taken from `instead`."""
    made = {}
    for one, process in zip(deployment.instances, processes, strict=True):
        judged = one.replaced(component=instead.get(one.name, one.component))
        for found in configuration(judged, process):
            made[(str(found.span.source.path), *_same(found)[1:])] = found
    return made
