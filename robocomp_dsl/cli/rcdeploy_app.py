"""From a DDSL file to something that can run: all checks of the text and of this machine.

In: a path and the options. Out: the deployment and its plan, or the findings that forbid it.
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


group = click.option("--group", metavar="NAME", help="Only what is in this group.")


@dataclass(frozen=True, slots=True)
class Checked:
    """`plan` is None when the text has errors; `ready`: nothing keeps it from running here."""

    findings: Sequence[Diagnostic]
    plan: Plan | None
    ready: bool


def check(
    path: Path,
    folders: Iterable[Path],
    name: str | None = None,
    domain: str | None = None,
    group: str | None = None,
) -> Checked:
    """Judge a deployment: first the text and all it imports, then what this machine has.

    With `group` it is about that group alone. Raises `click.BadParameter` where there is none.
    """
    from robocomp_dsl.check import check_ddsl  # noqa: PLC0415 - `rcdeploy status` needs no parser
    from robocomp_dsl.check.workspace import Workspace  # noqa: PLC0415
    from robocomp_dsl.deploy.freshness import outdated  # noqa: PLC0415
    from robocomp_dsl.deploy.preflight import preflight  # noqa: PLC0415
    from robocomp_dsl.deploy.selection import NoSuchGroup, only  # noqa: PLC0415

    report = Report()
    workspace = Workspace(folders)
    deployment = check_ddsl(path, workspace, report)
    if deployment is None or report.failed:
        return Checked(report.sorted(), None, ready=False)
    if group:
        try:
            deployment = only(deployment, group)
        except NoSuchGroup as error:
            raise click.BadParameter(str(error), param_hint="--group") from None
    running = name or (f"{deployment.name}-{group}" if group else deployment.name)
    made = plan(
        deployment,
        name=running,
        domain=domain or f"{running}-{secrets.token_hex(3)}",
        interpreter=sys.executable,
    )
    report.extend(preflight(deployment, made, ports=not _runs(made)))
    if not report.failed:
        report.extend(outdated(deployment, workspace.middlewares))
    return Checked(report.sorted(), made, ready=not report.failed)


def _runs(plan: Plan) -> bool:
    """Whether it is running already; then it is itself that has its ports."""
    from robocomp_dsl.deploy import folder  # noqa: PLC0415

    try:
        known = folder.running()
    except folder.Unavailable:
        return False
    return any(one.name == plan.name and one.path == str(plan.path.resolve()) for one in known)
