"""Loads a DDSL file for running: all checks of the text and of this machine.

In: a path and the options. Out: the deployment and its plan, or the findings that prevent it.
"""

from __future__ import annotations

import secrets
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.diagnostics import Diagnostic, Report

app = click.argument("app", metavar="APP.ddsl", type=click.Path(readable=False, path_type=Path))


group = click.option("--group", metavar="NAME", help="Only the components of this group.")


@dataclass(frozen=True, slots=True)
class CheckedDeployment:
    """`plan` is None if the text has errors; `ready`: it can run on this machine."""

    findings: Sequence[Diagnostic]
    plan: Plan | None
    ready: bool


def check(
    path: Path,
    folders: Iterable[Path],
    name: str | None = None,
    domain: str | None = None,
    group: str | None = None,
) -> CheckedDeployment:
    """Check a deployment: first the text and its imports, then the requirements on this machine.

    With `group` only that group is checked. Raises `click.BadParameter` for an unknown one.
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
    running = name or (f"{deployment.name}-{group}" if group else deployment.name)
    plan_ = plan(
        deployment,
        name=running,
        domain=domain or f"{running}-{secrets.token_hex(3)}",
        interpreter=sys.executable,
    )
    report.extend(preflight(deployment, plan_, ports=not _runs(plan_)))
    if not report.has_errors:
        report.extend(find_outdated(deployment, workspace.middlewares))
    return CheckedDeployment(report.sorted(), plan_, ready=not report.has_errors)


def _runs(plan: Plan) -> bool:
    """Whether it is already running, and therefore uses its ports itself."""
    from robocomp_dsl.deploy import instances  # noqa: PLC0415

    try:
        known = instances.running()
    except instances.Unavailable:
        return False
    return any(
        deployment.name == plan.name and deployment.path == str(plan.path.resolve())
        for deployment in known
    )
