"""`rcdeploy check`: checks a deployment. In: a DDSL file. Out: findings and an exit code."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app


@click.command()
@rcdeploy_app.app
@options.folders
@options.output_format
def command(app: Path, folders: tuple[Path, ...], output_format: str) -> None:
    """Check a deployment, its components, configurations and this machine; start nothing."""
    checked = rcdeploy_app.check(app, folders)
    options.print_findings(checked.findings, output_format, sys.stdout)
    if checked.plan is None or not checked.ready:
        raise CliError(EXIT_FINDINGS)
    if output_format == "full":
        count = len(checked.plan.components)
        print(f"{app}: {count} component{'s' if count != 1 else ''} can be started")
