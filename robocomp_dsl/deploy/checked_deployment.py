"""All findings about a deployment: those of its text, and why this machine cannot start it.

In: a DDSL file, or its checked model. Out: the findings, and the plan. `rcgen check`, `rcdeploy
check` and the commands that start components share this, so that they find the same.
"""

from __future__ import annotations

import secrets
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.freshness import find_outdated
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.deploy.preflight import preflight
from robocomp_dsl.deploy.selection import select_group
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.model.deployment import UNPLACED, Deployment


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


def check_deployment(
    path: Path,
    workspace: Workspace,
    name: str | None = None,
    domain: str | None = None,
    group: str | None = None,
) -> CheckedDeployment:
    """Check a deployment: first the text and its imports, then the requirements on this machine.

    With `group` only that group is checked; raises `NoSuchGroup` for an unknown one. Without
    `domain` the plan has the domain of the deployment if it runs, otherwise a new domain; over
    several hosts the domain has the name of the deployment.
    """
    report = Report()
    deployment = check_ddsl(path, workspace, report)
    if deployment is None or report.has_errors:
        return CheckedDeployment(report.sorted(), None, ready=False)
    if group:
        deployment = select_group(deployment, group)
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
    if all(instance.host is not UNPLACED for instance in deployment.instances):
        return deployment
    from robocomp_dsl.deploy.placement.place import place, placeable_locally  # noqa: PLC0415 - seldom needed

    if not placeable_locally(deployment):
        return deployment
    result = place(deployment, {}, {})
    report.extend(result.findings)
    return result.deployment


def _running_instance(name: str, path: Path) -> instances.RunningDeployment | None:
    """The running deployment of that name and file."""
    try:
        known = instances.running()
    except instances.Unavailable:
        return None
    file = str(path.resolve())
    return next((d for d in known if d.name == name and d.path == file), None)
