"""`rcdeploy plan --hosts`: asks the hosts for their load, and chooses as `up` would do now."""

from __future__ import annotations

import asyncio
import sys
from typing import TYPE_CHECKING

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import open_fleet
from robocomp_dsl.deploy.hosts.host_checks import describe_failure, host_spans
from robocomp_dsl.deploy.hosts.placing import PlacedPlan, candidate_hosts, place_on
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.model.deployment import Deployment

if TYPE_CHECKING:
    from robocomp_dsl.deploy.checked_deployment import CheckedDeployment


def placed_plan(checked: CheckedDeployment) -> PlacedPlan | None:
    """The plan with a host for each component; None if all have one. Raises `CliError`."""
    assert checked.plan  # noqa: S101 - it was checked
    assert checked.deployment  # noqa: S101
    try:
        result = asyncio.run(_ask_hosts(checked.deployment, checked.plan))
    except HostError as error:
        raise CliError(EXIT_FINDINGS, error.message) from None
    findings = result if isinstance(result, list) else result.findings if result else ()
    options.print_findings(findings, "full", sys.stderr)
    if findings:
        raise CliError(EXIT_FINDINGS)
    return None if isinstance(result, list) else result


async def _ask_hosts(deployment: Deployment, plan: Plan) -> PlacedPlan | list[Diagnostic] | None:
    """The plan, or findings about hosts that do not answer."""
    async with open_fleet(candidate_hosts(deployment), plan.name, with_facts=True) as fleet:
        if fleet.failures:
            spans = host_spans(deployment)
            return [
                describe_failure(failure, spans.get(name, deployment.span))
                for name, failure in fleet.failures.items()
            ]
        return await place_on(fleet, deployment, plan)
