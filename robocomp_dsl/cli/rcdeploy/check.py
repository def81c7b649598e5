"""`rcdeploy check`: checks a deployment. In: a DDSL file. Out: findings and an exit code."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.output.limit import limit_findings
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app


@click.command()
@rcdeploy_app.app
@options.folders
@options.output_format
def command(app: Path, folders: tuple[Path, ...], output_format: str) -> None:
    """Check a deployment, its components, configurations and this machine; start nothing."""
    checked = rcdeploy_app.check(app, folders)
    is_human = output_format in options.HUMAN_FORMATS
    shown, unlisted = limit_findings(checked.findings) if is_human else (checked.findings, [])
    options.print_findings(shown, output_format, sys.stdout)
    sys.stdout.flush()
    for line in unlisted:
        print(line, file=sys.stderr)
    if checked.plan is None or not checked.ready:
        raise CliError(EXIT_FINDINGS)
    if output_format == "full":
        count = len(checked.plan.components)
        print(f"{app}: {count} component{'s' if count != 1 else ''} can be started")
