"""Loads a DDSL file for running: all checks of the text and of this machine.

In: a path and the options. Out: the deployment and its plan, or the findings that prevent it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError

if TYPE_CHECKING:
    from robocomp_dsl.deploy.checked_deployment import CheckedDeployment

app = click.argument("app", metavar="APP.ddsl", type=click.Path(readable=False, path_type=Path))


group = click.option("--group", metavar="NAME", help="Only the components of this group.")


def check(
    path: Path,
    folders: Iterable[Path],
    name: str | None = None,
    domain: str | None = None,
    group: str | None = None,
) -> CheckedDeployment:
    """All findings of `check_deployment`; raises `click.BadParameter` for an unknown group."""
    from robocomp_dsl.check.workspace.workspace import Workspace  # noqa: PLC0415 - `rcdeploy status` needs no parser
    from robocomp_dsl.deploy.checked_deployment import check_deployment  # noqa: PLC0415
    from robocomp_dsl.deploy.selection import NoSuchGroup  # noqa: PLC0415

    try:
        return check_deployment(path, Workspace(folders), name, domain, group)
    except NoSuchGroup as error:
        raise click.BadParameter(str(error), param_hint="--group") from None


def require_hosts(checked: CheckedDeployment, app: Path) -> None:
    """Print the findings of the text; raise `CliError` unless it can run on several hosts."""
    options.print_findings(checked.findings, "full", sys.stderr)
    if checked.plan is None or not checked.ready:
        raise CliError(EXIT_FINDINGS)
    if not checked.hosted:
        text = f"{app}: all components are on this machine; `rcdeploy up` runs them"
        raise CliError(EXIT_FINDINGS, text)
