"""`rcdeploy hosts APP.ddsl`: a table of hosts. Exit code 1 if one cannot be used."""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.cli.rcdeploy import hosts_deployment

if TYPE_CHECKING:
    from robocomp_dsl.deploy.hosts.host_checks import CheckedHosts
    from robocomp_dsl.deploy.hosts.host_facts import HostFacts
    from robocomp_dsl.model.deployment import Deployment, Host

COLUMNS = ("HOST", "ADDRESS", "USER", "STATE", "SYSTEMD", "PYTHON", "FREE", "LOAD", "CLOCK")
EMPTY = "-"
DEFAULT_CLOCK_LIMIT_MS = 50.0


@click.command("show")
@rcdeploy_app.app
@options.folders
@click.option(
    "--clock-limit",
    type=click.FloatRange(min=0),
    default=DEFAULT_CLOCK_LIMIT_MS,
    show_default=True,
    metavar="MS",
    help="Warn if a clock differs by more.",
)
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(app: Path, folders: tuple[Path, ...], clock_limit: float, output_format: str) -> None:
    """Connect to all hosts of a deployment, check them, and show what they are.

    The clock is how far that of the host is ahead of this machine, with the uncertainty of the
    measurement. Exit code 1: a host cannot be used.
    """
    from robocomp_dsl.cli.output.render import strip_control_chars  # noqa: PLC0415 - not for --help

    deployment = hosts_deployment.load(app, folders)
    hosts = hosts_deployment.hosts_of(deployment)
    if not hosts and output_format == "text":
        print("all components run on this machine: there is no host to check")
        return
    checked = asyncio.run(_check(deployment, hosts, clock_limit / 1e3))
    if output_format == "json":
        print(json.dumps(as_dict(checked), indent=2))
    else:
        for line in format_table(checked):
            print(strip_control_chars(line))  # hosts write parts of it
        sys.stdout.flush()
        options.print_findings(checked.findings, "full", sys.stderr)
    if not checked.can_start:
        raise CliError(EXIT_FINDINGS)


async def _check(
    deployment: Deployment, hosts: Sequence[Host], clock_limit_s: float
) -> CheckedHosts:
    from robocomp_dsl.deploy.hosts.host_checks import HostLimits, check_hosts  # noqa: PLC0415

    limits = HostLimits(clock_s=clock_limit_s)
    checked = await check_hosts(deployment, deployment.name, hosts, limits)
    await checked.close()
    return checked


def as_dict(checked: CheckedHosts) -> dict[str, Any]:
    """The hosts for JSON: what is written of each, its facts and its findings."""
    return {"hosts": [_host_dict(host, checked) for host in checked.hosts]}


def _host_dict(host: Host, checked: CheckedHosts) -> dict[str, Any]:
    facts = checked.facts.get(host.name)
    findings = [
        {"code": finding.code.id, "severity": str(finding.severity), "message": finding.message}
        for finding in checked.findings_of(host)
    ]
    return {
        "name": host.name,
        "address": host.address,
        "ssh_port": host.ssh_port,
        "user": facts.user if facts else host.user,
        "reachable": facts is not None,
        "usable": not checked.has_errors(host),
        "findings": findings,
        "facts": facts.as_dict() if facts else None,
    }


def format_table(checked: CheckedHosts) -> list[str]:
    """One line per host below a header."""
    rows = [COLUMNS, *(_cells(host, checked) for host in checked.hosts)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(COLUMNS))]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]


def _cells(host: Host, checked: CheckedHosts) -> tuple[str, ...]:
    address = f"{host.address}:{host.ssh_port}" if host.ssh_port else host.address
    names = (host.name or host.address, address)
    if facts := checked.facts.get(host.name):
        state = "not usable" if checked.has_errors(host) else "usable"
        return (*names, facts.user, state, *_fact_cells(host, facts))
    failure = checked.failures.get(host.name)
    state = failure.state if failure else EMPTY
    return (*names, host.user or EMPTY, state, *[EMPTY] * 5)


def _fact_cells(host: Host, facts: HostFacts) -> tuple[str, ...]:
    from robocomp_dsl.deploy.hosts.host_checks import format_bytes  # noqa: PLC0415

    python = facts.python or next(iter(facts.pythons), None)
    return (
        f"{facts.systemd} {facts.manager or '(no manager)'}" if facts.systemd else "none",
        ".".join(map(str, python.version)) if python else "none",
        format_bytes(facts.free_bytes),
        f"{facts.load[0]:.2f} of {facts.cpus}",
        EMPTY if host.is_local else facts.clock.format(),
    )
