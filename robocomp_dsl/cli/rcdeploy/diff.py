"""`rcdeploy diff`: compares hosts with the description. In: a DDSL file. Out: what `up` changes."""

from __future__ import annotations

import json
from pathlib import Path

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app


@click.command()
@rcdeploy_app.app
@options.folders
@rcdeploy_app.group
@click.option("--name", metavar="NAME", help="Name of the deployment; default: that in the file.")
@click.option("--domain", metavar="NAME", help="Communication domain; default: its name.")
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(
    app: Path,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    output_format: str,
) -> None:
    """Compare what runs on the hosts with the description; change nothing.

    Shows which components `up` would start, restart or stop, and why. Exit code 0: nothing differs;
    1: something does, or a host cannot be checked.
    """
    checked = rcdeploy_app.check(app, folders, name, domain, group)
    rcdeploy_app.require_hosts(checked, app)
    from robocomp_dsl.cli.rcdeploy import up_hosts  # noqa: PLC0415 - loads asyncssh
    from robocomp_dsl.deploy.hosts.deployer import Deployer  # noqa: PLC0415
    from robocomp_dsl.deploy.hosts.differences import format_changes  # noqa: PLC0415

    changes = up_hosts.run(checked, Deployer.diff, quiet=output_format == "json")
    if output_format == "json":
        print(json.dumps([each.as_dict() for each in changes], indent=1))
    else:
        print("\n".join(format_changes(changes)) or f"{app}: runs as described")
    if changes:
        raise CliError(EXIT_FINDINGS)
