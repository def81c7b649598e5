"""Loads a DDSL file for running: all checks of the text and of this machine.

In: a path and the options. Out: the deployment and its plan, or the findings that prevent it.
"""

from __future__ import annotations

import secrets
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.diagnostics import Diagnostic, Report

if TYPE_CHECKING:
    from robocomp_dsl.deploy.instances import RunningDeployment
    from robocomp_dsl.model.deployment import Deployment

app = click.argument("app", metavar="APP.ddsl", type=click.Path(readable=False, path_type=Path))


group = click.option("--group", metavar="NAME", help="Only the components of this group.")


@dataclass(frozen=True, slots=True)
class CheckedDeployment:
    """`plan` is None if the text has errors; `ready`: this machine can start it.

    `hosted`: a component runs on another machine.
    """

    findings: Sequence[Diagnostic]
    plan: Plan | None
    ready: bool
    deployment: Deployment | None = None
    hosted: bool = False


def check(
    path: Path,
    folders: Iterable[Path],
    name: str | None = None,
    domain: str | None = None,
    group: str | None = None,
) -> CheckedDeployment:
    """Check a deployment: first the text and its imports, then the requirements on this machine.

    With `group` only that group is checked; raises `click.BadParameter` for an unknown one. Without
    `domain` the plan has the domain of the deployment if it runs, otherwise a new domain; over
    several hosts the domain has the name of the deployment.
    """
    from robocomp_dsl.check.passes import check_ddsl  # noqa: PLC0415 - `rcdeploy status` needs no parser
    from robocomp_dsl.check.workspace.workspace import Workspace  # noqa: PLC0415
    from robocomp_dsl.deploy.freshness import find_outdated  # noqa: PLC0415
    from robocomp_dsl.deploy.preflight import preflight  # noqa: PLC0415
    from robocomp_dsl.deploy.selection import NoSuchGroup, select_group  # noqa: PLC0415

    report = Report()
    workspace = Workspace(folders)
    deployment = check_ddsl(path, workspace, report)
    if deployment is None or report.has_errors:
        return CheckedDeployment(report.sorted(), None, ready=False)
    if group:
        try:
            deployment = select_group(deployment, group)
        except NoSuchGroup as error:
            raise click.BadParameter(str(error), param_hint="--group") from None
    deployment = _placed_locally(deployment, report)
    running = name or (f"{deployment.name}-{group}" if group else deployment.name)
    hosted = any(not instance.host.is_local for instance in deployment.instances)
    instance = None if hosted else _running_instance(running, path)
    new_domain = running if hosted else f"{running}-{secrets.token_hex(3)}"
    plan_ = plan(
        deployment,
        name=running,
        domain=domain or (instance.domain if instance else new_domain),
        interpreter=sys.executable,
    )
    # If it is running already, then it is itself that has its ports.
    report.extend(preflight(deployment, plan_, ports=not hosted and instance is None))
    if not report.has_errors:
        report.extend(find_outdated(deployment, workspace.middlewares.names))
    ready = not report.has_errors
    return CheckedDeployment(report.sorted(), plan_, ready, deployment, hosted)


def _placed_locally(deployment: Deployment, report: Report) -> Deployment:
    """The deployment with a host for each component, if only this machine can be chosen."""
    from robocomp_dsl.model.deployment import UNPLACED  # noqa: PLC0415 - not for --help

    if all(instance.host is not UNPLACED for instance in deployment.instances):
        return deployment
    from robocomp_dsl.deploy.placement.place import place, placeable_locally  # noqa: PLC0415

    if not placeable_locally(deployment):
        return deployment
    result = place(deployment, {}, {})
    report.extend(result.findings)
    return result.deployment


def require_hosts(checked: CheckedDeployment, app: Path) -> None:
    """Print the findings of the text; raise `CliError` unless it can run on several hosts."""
    options.print_findings(checked.findings, "full", sys.stderr)
    if checked.plan is None or not checked.ready:
        raise CliError(EXIT_FINDINGS)
    if not checked.hosted:
        text = f"{app}: all components are on this machine; `rcdeploy up` runs them"
        raise CliError(EXIT_FINDINGS, text)


def _running_instance(name: str, path: Path) -> RunningDeployment | None:
    """The running deployment of that name and file."""
    from robocomp_dsl.deploy import instances  # noqa: PLC0415

    try:
        known = instances.running()
    except instances.Unavailable:
        return None
    file = str(path.resolve())
    return next((d for d in known if d.name == name and d.path == file), None)
