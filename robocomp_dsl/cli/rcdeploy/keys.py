"""`rcdeploy keys`: certificates of a deployment over hosts. In: a DDSL file. Out: files."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.output.render import strip_control_chars
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.diagnostics import Report

if TYPE_CHECKING:
    from robocomp_dsl.deploy.network.key_folder import KeyFolder
    from robocomp_dsl.deploy.network.update_keys import KeyChange
    from robocomp_dsl.model.deployment import Deployment

_SHORT_FINGERPRINT = 16
_MAX_DAYS = 3650


@click.command()
@rcdeploy_app.app
@options.folders
@click.option("--renew", is_flag=True, help="Make all anew, also the certificate authority.")
@click.option(
    "--days",
    type=click.FloatRange(0, _MAX_DAYS, min_open=True),
    default=90.0,
    show_default=True,
    help="How long new certificates are valid.",
)
@click.option("--show", is_flag=True, help="Change nothing; list names, expiry and fingerprints.")
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(
    app: Path,
    folders: tuple[Path, ...],
    renew: bool,
    days: float,
    show: bool,
    output_format: str,
) -> None:
    """Make the certificates with which the components of APP.ddsl connect over hosts.

    A certificate authority, and a certificate for each component, for the router of each host, and
    for rcdeploy. Running it again adds what is missing, and renews what ends within a third of its
    life. The keys are in `~/.config/robocomp/keys/NAME`; nobody else may read them.
    """
    from robocomp_dsl.deploy.network.certificates import UnusableKey  # noqa: PLC0415 - TLS library
    from robocomp_dsl.deploy.network.identities import needs_network  # noqa: PLC0415
    from robocomp_dsl.deploy.network.key_folder import UnsafeKeys, key_folder  # noqa: PLC0415

    deployment = _load(app, folders)
    if not needs_network(deployment):
        print(f"{app}: all components are on this machine, and need no keys")
        return
    folder = key_folder(deployment.name)
    try:
        if show:
            _show(deployment, folder, output_format)
        else:
            _update(deployment, folder, days, renew=renew, output_format=output_format)
    except (UnsafeKeys, UnusableKey) as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def _load(app: Path, folders: Iterable[Path]) -> Deployment:
    """The deployment; exits with its findings if it has errors."""
    from robocomp_dsl.check.passes import check_ddsl  # noqa: PLC0415
    from robocomp_dsl.check.workspace.workspace import Workspace  # noqa: PLC0415

    report = Report()
    deployment = check_ddsl(app, Workspace(folders), report)
    options.print_findings(report.sorted(), "full", sys.stderr)
    if deployment is None or report.has_errors:
        raise CliError(EXIT_FINDINGS)
    return deployment


def _now() -> datetime:
    return datetime.now(UTC)


def _update(
    deployment: Deployment, folder: KeyFolder, days: float, *, renew: bool, output_format: str
) -> None:
    from robocomp_dsl.deploy.network.identities import identities  # noqa: PLC0415
    from robocomp_dsl.deploy.network.update_keys import KEPT, update_keys  # noqa: PLC0415

    changes = update_keys(
        deployment.name, identities(deployment), folder, _now(), days=days, renew=renew
    )
    _print(changes, folder, output_format)
    if output_format == "text" and any(change.action != KEPT for change in changes):
        print(f"`rcdeploy {deployment.path.name} up` copies them to the hosts")


def _show(deployment: Deployment, folder: KeyFolder, output_format: str) -> None:
    """What is there, and what is wrong with it."""
    from robocomp_dsl.deploy.network.certificates import read_certificate  # noqa: PLC0415
    from robocomp_dsl.deploy.network.identities import identities  # noqa: PLC0415
    from robocomp_dsl.deploy.network.key_checks import check_keys  # noqa: PLC0415
    from robocomp_dsl.deploy.network.key_folder import AUTHORITY  # noqa: PLC0415
    from robocomp_dsl.deploy.network.update_keys import KEPT, KeyChange  # noqa: PLC0415

    report = Report()
    check_keys(deployment, folder, _now(), report)
    every = [(AUTHORITY, "authority"), *((e.name, e.kind) for e in identities(deployment))]
    _print(
        [
            KeyChange(name, kind, KEPT, "", read_certificate(folder.certificate(name)))
            for name, kind in every
            if folder.certificate(name).exists()
        ],
        folder,
        output_format,
    )
    options.print_findings(report.sorted(), "full", sys.stderr)
    if report.has_errors:
        raise CliError(EXIT_FINDINGS)


def _print(changes: Iterable[KeyChange], folder: KeyFolder, output_format: str) -> None:
    if output_format == "json":
        print(json.dumps([_as_data(change, folder) for change in changes], indent=1))
        return
    print(f"keys in {folder.path}")
    for line in _table(changes):
        print(strip_control_chars(line))


def _table(changes: Iterable[KeyChange]) -> Iterator[str]:
    now = _now()
    rows = [("NAME", "KIND", "ENDS", "FINGERPRINT (SHA-256)", "")]
    for change in changes:
        days = (change.facts.end - now).days
        left = "expired" if change.facts.end <= now else f"in {days} day{'s' * (days != 1)}"
        reason = f": {change.reason}" if change.reason else ""
        rows.append(
            (
                change.name,
                change.kind,
                f"{change.facts.end:%Y-%m-%d}, {left}",
                change.facts.fingerprint[:_SHORT_FINGERPRINT],
                "" if change.action == "valid" else f"{change.action}{reason}",
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    for row in rows:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()


def _as_data(change: KeyChange, folder: KeyFolder) -> dict[str, Any]:
    return {
        "name": change.name,
        "kind": change.kind,
        "begin": change.facts.begin.isoformat(),
        "end": change.facts.end.isoformat(),
        "fingerprint": change.facts.fingerprint,
        "addresses": list(change.facts.addresses),
        "certificate": str(folder.certificate(change.name)),
        "action": change.action,
        "reason": change.reason,
    }
