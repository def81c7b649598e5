"""The deployment of a `rcdeploy hosts` command, with only its text checked."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.model.deployment import Deployment, Host


def load(path: Path, folders: Sequence[Path]) -> Deployment:
    """The deployment of a file; prints the findings. Raises `CliError` if there are errors."""
    from robocomp_dsl.check.passes import check_ddsl  # noqa: PLC0415 - not for --help
    from robocomp_dsl.check.workspace.workspace import Workspace  # noqa: PLC0415

    report = Report()
    deployment = check_ddsl(path, Workspace(folders), report)
    if deployment is None or report.has_errors:
        options.print_findings(report.sorted(), "full", sys.stderr)
        raise CliError(EXIT_FINDINGS, f"{path}: {options.summary(report.sorted())}")
    return deployment


def hosts_of(deployment: Deployment) -> tuple[Host, ...]:
    """All hosts that are declared or used; those on this machine are one.

    None if all components run on this machine: the supervisor that starts them needs no systemd.
    """
    from robocomp_dsl.deploy.hosts.host_checks import used_hosts  # noqa: PLC0415

    used = used_hosts(deployment)
    remote = {host.name: host for host in (*deployment.hosts, *used) if not host.is_local}
    local = [host for host in used if host.is_local and remote]
    return (*local[:1], *remote.values())


def select(hosts: Sequence[Host], names: Sequence[str]) -> list[Host]:
    """The hosts of these names; all without names. Raises `click.UsageError`."""
    known = {host.name: host for host in hosts}
    for name in names:
        if name not in known:
            guess = did_you_mean(name, known)
            raise click.UsageError(f"there is no host `{name}`" + (f"; {guess}" if guess else ""))
    return [known[name] for name in dict.fromkeys(names)] or list(hosts)
