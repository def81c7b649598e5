"""`rcdeploy check`: is everything there? In: a DDSL file. Out: findings and an exit code."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from robocomp_dsl.cli import options, rcdeploy_app
from robocomp_dsl.cli.program import FINDINGS


@click.command()
@rcdeploy_app.app
@options.folders
@options.output_format
def command(app: Path, folders: tuple[Path, ...], form: str) -> None:
    """Check a deployment, its components, configurations and this machine; start nothing."""
    checked = rcdeploy_app.check(app, folders)
    options.show(checked.findings, form, sys.stdout)
    if checked.plan is None or not checked.ready:
        sys.exit(FINDINGS)
    if form == "full":
        count = len(checked.plan.processes)
        print(f"{app}: {count} component{'s' if count != 1 else ''} can be started")
