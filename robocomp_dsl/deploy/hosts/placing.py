"""Chooses the hosts of components that name none, when the deployment starts.

In: a fleet, a deployment. Out: the deployment and its plan with a host for each component.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.deploy.hosts.description import deployment_hosts
from robocomp_dsl.deploy.hosts.differences import stored_manifest
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.rollout import raise_failures
from robocomp_dsl.deploy.network.identities import host_name
from robocomp_dsl.deploy.placement.host_load import HostLoad
from robocomp_dsl.deploy.placement.place import is_placed, place
from robocomp_dsl.deploy.placement.placement_choice import PlacementChoice
from robocomp_dsl.deploy.placement.placement_text import placement_lines
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.model.deployment import Deployment, Host


@dataclass(frozen=True, slots=True)
class PlacedPlan:
    """A deployment with a host for each component, its plan, and the choices, also as text."""

    deployment: Deployment
    plan: Plan
    findings: Sequence[Diagnostic]
    lines: Sequence[str]
    choices: Sequence[PlacementChoice]


def candidate_hosts(deployment: Deployment) -> tuple[Host, ...]:
    """The hosts on which components run, or may run."""
    if is_placed(deployment):
        return deployment_hosts(deployment)
    used = {host.name: host for host in deployment_hosts(deployment)}
    candidates = {n for i in deployment.instances for n in i.placement.candidates}
    for host in deployment.hosts:
        if host.name in candidates:
            name = host_name(host)
            used.setdefault(name, host.replace(name=name))
    return tuple(used.values())


async def place_on(fleet: Fleet, deployment: Deployment, before: Plan) -> PlacedPlan | None:
    """Place the components by the loads of the hosts; None if all have a host."""
    if is_placed(deployment):
        return None
    reports = await fleet.reports()
    raise_failures(fleet)
    instances = {process.name: i.name for process, i in _pairs(before, deployment)}
    running = {}
    for host, report in reports.items():
        manifest = stored_manifest(report)
        for component in manifest.components if manifest else ():
            state = report.states.get(component.unit)
            if state is not None and state.is_active:
                for name in component.member_names or (component.name,):
                    running[instances.get(name, name)] = host
    loads = {n: HostLoad(*facts.load, facts.cpus) for n, facts in fleet.facts.items()}
    result = place(deployment, loads, running)
    placed = plan(
        result.deployment, name=before.name, domain=before.domain, interpreter=sys.executable
    )
    return PlacedPlan(
        result.deployment,
        placed,
        result.findings,
        list(placement_lines(result.choices)),
        result.choices,
    )


def _pairs(before: Plan, deployment: Deployment) -> zip:  # type: ignore[type-arg]
    return zip(before.components, deployment.instances, strict=True)
