"""`rcdeploy up` over several hosts. In: a checked deployment. Out: its outcome as an exit code."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.running import say
from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.hosts.deployer import Deployer, Rejected
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.host_checks import HostLimits

if TYPE_CHECKING:
    from robocomp_dsl.deploy.checked_deployment import CheckedDeployment

Result = TypeVar("Result")


def _reject_supervised(name: str) -> None:
    """Raise `CliError` if a deployment of that name runs on this machine with a supervisor."""
    try:
        found = [running for running in instances.running() if running.name == name]
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if found:
        text = (
            f"`{name}` already runs on this machine (pid {found[0].pid}, {found[0].path}); stop it,"
            " or use another --name"
        )
        raise CliError(EXIT_FINDINGS, text)


def _ignore(text: str) -> None:
    """Print nothing."""


def command(
    checked: CheckedDeployment, *, follow: bool, clock_limit_ms: float | None = None
) -> None:
    """Deploy, wait until all components are ready, and print how it went."""
    limits = HostLimits() if clock_limit_ms is None else HostLimits(clock_s=clock_limit_ms / 1e3)
    assert checked.plan  # noqa: S101 - it was checked
    name = checked.plan.name
    _reject_supervised(name)
    result = run(checked, Deployer.up, limits=limits)
    version = result.version
    if not result.changes:
        say(f"{name}: nothing changes, version {version} runs as described")
    elif result.failed:
        listed = ", ".join(result.failed)
        say(f"{name}: version {version} is deployed; failed: {listed}")
    else:
        say(f"{name}: version {version} is deployed, all components are ready")
    if follow:
        from robocomp_dsl.cli.rcdeploy import logs  # noqa: PLC0415 - only then

        logs.follow_hosted(name)
    if result.failed:
        raise CliError(EXIT_FINDINGS)


def reject_options(how: Mapping[str, Any]) -> None:
    """Raise `click.UsageError` for an option of the supervisor that systemd does not have."""
    for name in ("duration", "keep_going", "live"):
        if how.get(name):
            option = {"live": "--table"}.get(name, f"--{name.replace('_', '-')}")
            raise click.UsageError(f"{option} is for deployments on one machine")


def run(
    checked: CheckedDeployment,
    work: Callable[[Deployer], Coroutine[Any, Any, Result]],
    *,
    quiet: bool = False,
    limits: HostLimits | None = None,
) -> Result:
    """Run `work` of a deployer; its findings are printed. Raises `CliError`."""
    assert checked.plan  # noqa: S101 - it was checked
    assert checked.deployment  # noqa: S101
    deployer = Deployer(checked.deployment, checked.plan, _ignore if quiet else say, limits)
    try:
        result = asyncio.run(work(deployer))
    except Rejected as rejected:
        options.print_findings(rejected.findings, "full", sys.stderr)
        summary = options.summary(rejected.findings)
        raise CliError(EXIT_FINDINGS, f"nothing was changed ({summary})") from None
    except HostError as error:
        text = f"{error.message}\n{error.help}" if error.help else error.message
        raise CliError(EXIT_FINDINGS, text) from None
    options.print_findings(deployer.warnings, "full", sys.stderr)
    return result
