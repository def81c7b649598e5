"""`rcgen breaking` for deployments: checks a deployment against old and new components.

In: a DDSL file, its path in the earlier version, and the folders of both versions. Out: the errors
that occur only with the new components, and the other errors of the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.breaking import codes
from robocomp_dsl.check.codes import deployment as deployment_codes
from robocomp_dsl.check.codes import names as name_codes
from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy import codes as deploy_codes
from robocomp_dsl.deploy.plan import Process, plan
from robocomp_dsl.deploy.preflight import check_configuration
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment

_VALUE_CODES = frozenset(
    (
        deployment_codes.UNKNOWN_SETTING,
        deployment_codes.SETTING_TYPE,
        deployment_codes.SETTING_RANGE,
        deploy_codes.CONFIGURATION,
    )
)
_IMPORT_ERRORS = frozenset((name_codes.MISSING_IMPORT, name_codes.UNREADABLE_IMPORT))


@dataclass(slots=True)
class DeploymentCheck:
    """`broken`: findings about connections and values; `own`: errors of the file itself."""

    broken: list[Diagnostic] = field(default_factory=list)
    own: list[Diagnostic] = field(default_factory=list)
    deployment: Deployment | None = None


def check_deployment(
    path: Path, then: Path | None, new: Iterable[Path], old: Iterable[Path]
) -> DeploymentCheck:
    """The deployment at `path`; `then` is its path in the earlier version, if it exists there.

    `new` and `old` are the interface folders of both versions.
    """
    current, deployment = _check(path, Workspace(new))
    result = DeploymentCheck(deployment=deployment)
    before, earlier = _check_against_earlier(path, then, old) if then else ([], None)
    known = {_fingerprint(finding) for finding in before}
    comparable = earlier is not None and not any(
        finding.code in _IMPORT_ERRORS for finding in before
    )
    for finding in current:
        if comparable and _fingerprint(finding) not in known:
            result.broken.append(_breaking_finding(finding, deployment or earlier))
        elif finding.severity is Severity.ERROR:
            result.own.append(finding)
    if deployment and earlier and comparable:
        result.broken += _values(deployment, earlier)
    return result


def _check(path: Path, workspace: Workspace) -> tuple[list[Diagnostic], Deployment | None]:
    """Errors of the file itself."""
    report = Report()
    deployment = check_ddsl(path, workspace, report)
    found = [finding for finding in report if finding.span.source.path == path]
    wrong = [finding for finding in found if finding.severity is Severity.ERROR]
    return [
        *wrong,
        *(finding for finding in found if finding.code is deployment_codes.NO_PUBLISHER),
    ], deployment


def _check_against_earlier(
    path: Path, then: Path, old: Iterable[Path]
) -> tuple[list[Diagnostic], Deployment | None]:
    """The current text among the earlier descriptions."""
    workspace = Workspace(old)
    workspace.sources.set_overlay(then, workspace.sources.read(path).text)
    return _check(then, workspace)


def _fingerprint(finding: Diagnostic) -> tuple[str, int, int, str]:
    return (finding.code.id, finding.span.start, finding.span.end, finding.message)


def _breaking_finding(finding: Diagnostic, deployment: Deployment | None) -> Diagnostic:
    code = codes.VALUES if finding.code in _VALUE_CODES else codes.WIRING
    return _with_deployment_name(deployment, finding.replace(code=code, fix=None))


def _with_deployment_name(deployment: Deployment | None, finding: Diagnostic) -> Diagnostic:
    name = f"deployment `{deployment.name}`: " if deployment else ""
    return finding.replace(message=f"{name}{finding.message}")


def _values(deployment: Deployment, earlier: Deployment) -> Iterator[Diagnostic]:
    """Configuration values that the current components reject and the earlier ones accepted."""
    was = {instance.name: instance.component for instance in earlier.instances}
    processes = plan(deployment, name="", domain="", interpreter="python3").components
    before = _rejected_values(deployment, processes, was)
    for place, found in _rejected_values(deployment, processes, {}).items():
        if place not in before:
            yield _with_deployment_name(deployment, found.replace(code=codes.VALUES))


def _rejected_values(
    deployment: Deployment, processes: Iterable[Process], instead: Mapping[str, Component]
) -> dict[tuple[str, int, int, str], Diagnostic]:
    """Invalid values; the components of some instances are replaced by those in `instead`."""
    result = {}
    for instance, process in zip(deployment.instances, processes, strict=True):
        judged = instance.replace(component=instead.get(instance.name, instance.component))
        for found in check_configuration(judged, process):
            result[(str(found.span.source.path), *_fingerprint(found)[1:])] = found
    return result
