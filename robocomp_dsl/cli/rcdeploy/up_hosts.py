"""`rcdeploy up` over several hosts. In: a checked deployment. Out: its outcome as an exit code."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any, TypeVar

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.app import CheckedDeployment
from robocomp_dsl.deploy.hosts.deployer import Deployer, Rejected
from robocomp_dsl.deploy.hosts.errors import HostError

say = partial(print, flush=True)
Result = TypeVar("Result")


def command(checked: CheckedDeployment, *, follow: bool) -> None:
    """Deploy, wait until all components are ready, and print how it went."""
    result = run(checked, Deployer.up)
    assert checked.plan  # noqa: S101 - it was checked
    name, version = checked.plan.name, result.version
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


def run(
    checked: CheckedDeployment, work: Callable[[Deployer], Coroutine[Any, Any, Result]]
) -> Result:
    """Run `work` of a deployer; its findings are printed. Raises `CliError`."""
    assert checked.plan  # noqa: S101 - it was checked
    assert checked.deployment  # noqa: S101
    deployer = Deployer(checked.deployment, checked.plan, say)
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
