"""`rcdeploy export`: writes a deployment for systemd, compose or Kubernetes. In: a DDSL file."""

from __future__ import annotations

import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.diagnostics import Report

if TYPE_CHECKING:
    from robocomp_dsl.deploy.export.folder import ExportFile
    from robocomp_dsl.model.deployment import Deployment

SYSTEMD, COMPOSE, KUBERNETES = "systemd", "compose", "kubernetes"


@click.command()
@rcdeploy_app.app
@click.argument("folder", metavar="DIR", type=click.Path(file_okay=False, path_type=Path))
@click.option(
    "--to",
    "target",
    type=click.Choice([SYSTEMD, COMPOSE, KUBERNETES]),
    required=True,
    help="The system that runs the deployment.",
)
@options.folders
@rcdeploy_app.group
@click.option("--name", metavar="NAME", help="Name of the deployment; default: as in the file.")
@click.option("--domain", metavar="NAME", help="Communication domain; default: the name.")
@click.option("--keys", is_flag=True, help="Also make the keys that the deployment needs there.")
def command(
    app: Path,
    folder: Path,
    target: str,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    keys: bool,
) -> None:
    """Write APP.ddsl into DIR as units of systemd, a compose file, or objects of Kubernetes.

    DIR has everything but keys; its README.md says how to start it. What the other system cannot do
    is reported. A later export replaces only files that an export has written.
    """
    from robocomp_dsl.deploy.export import codes  # noqa: PLC0415 - not for --help
    from robocomp_dsl.deploy.export.folder import ForeignFiles, write_folder  # noqa: PLC0415

    checked = rcdeploy_app.check(app, folders, name, domain, group)
    if checked.plan is None or checked.deployment is None or not checked.ready:
        options.print_findings(checked.findings, "full", sys.stderr)
        raise CliError(EXIT_FINDINGS, f"{app}: nothing was written")
    deployment = checked.deployment
    report = Report()
    report.extend(checked.findings)
    running = checked.plan.name
    files = _files(deployment, target, running, domain or running, report)
    if report.has_errors:
        options.print_findings(report.sorted(), "full", sys.stderr)
        raise CliError(EXIT_FINDINGS, f"{app}: nothing was written")
    try:
        changed = write_folder(folder, target, files)
    except ForeignFiles as error:
        report.add(
            codes.FOLDER,
            deployment.span,
            f"{folder} has files that `rcdeploy export` did not write: {error}",
            help="export into a new folder, or move these files away",
        )
        options.print_findings(report.sorted(), "full", sys.stderr)
        raise CliError(EXIT_FINDINGS, f"{app}: nothing was written") from None
    except OSError as error:
        raise CliError(EXIT_FINDINGS, f"{folder} cannot be written: {error}") from None
    options.print_findings(report.sorted(), "full", sys.stderr)
    print(f"{folder}: {len(files)} files, {changed} changed; {folder}/README.md says how to start")
    if keys:
        _make_keys(deployment, target, running)


def _files(
    deployment: Deployment, target: str, name: str, domain: str, report: Report
) -> dict[str, ExportFile]:
    if target == SYSTEMD:
        from robocomp_dsl.deploy.export.systemd import systemd_files  # noqa: PLC0415

        return systemd_files(deployment, name, domain, report)
    from robocomp_dsl.deploy.export import network, prepare  # noqa: PLC0415
    from robocomp_dsl.deploy.export.compose import compose_files  # noqa: PLC0415
    from robocomp_dsl.deploy.export.kubernetes import kubernetes_files  # noqa: PLC0415

    host = network.container_host(target, name)
    exported = prepare.prepare(deployment, name, domain, host, report)
    make = compose_files if target == COMPOSE else kubernetes_files
    return make(exported, report)


def _make_keys(deployment: Deployment, target: str, name: str) -> None:
    """Make the certificates of the exported deployment, or renew them."""
    from robocomp_dsl.deploy.export import network  # noqa: PLC0415
    from robocomp_dsl.deploy.export.readme import key_name  # noqa: PLC0415
    from robocomp_dsl.deploy.network.certificates import UnusableKey  # noqa: PLC0415 - TLS library
    from robocomp_dsl.deploy.network.identities import identities  # noqa: PLC0415
    from robocomp_dsl.deploy.network.key_folder import UnsafeKeys, key_folder  # noqa: PLC0415
    from robocomp_dsl.deploy.network.update_keys import update_keys  # noqa: PLC0415

    if target == SYSTEMD:
        print(f"`rcdeploy keys {deployment.path}` makes the keys of a deployment over hosts")
        return
    host = network.container_host(target, name)
    moved = network.moved_to(deployment, host)
    folder = key_folder(key_name(deployment.name, target))
    try:
        changes = list(update_keys(deployment.name, identities(moved), folder, datetime.now(UTC)))
    except (UnsafeKeys, UnusableKey) as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    print(f"{folder.path}: keys of {len(changes)} programs")
