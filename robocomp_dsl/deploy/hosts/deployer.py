"""Checks, describes and rolls out a deployment over hosts.

In: a checked deployment and its plan. Out: findings, differences, or running units. All checks on
all hosts come before the first change.
"""

from __future__ import annotations

import time
from collections.abc import AsyncIterator, Callable, Iterable
from contextlib import asynccontextmanager
from datetime import UTC, datetime

from robocomp_dsl.deploy.hosts import registry
from robocomp_dsl.deploy.hosts.core_checks import check_cores
from robocomp_dsl.deploy.hosts.description import all_components, deployment_hosts
from robocomp_dsl.deploy.hosts.differences import HostChanges
from robocomp_dsl.deploy.hosts.fleet import Fleet, open_fleet
from robocomp_dsl.deploy.hosts.fleet_content import FleetContent
from robocomp_dsl.deploy.hosts.host_checks import (
    HostLimits,
    check_facts,
    describe_failure,
    host_spans,
)
from robocomp_dsl.deploy.hosts.last_lines import show_last_lines
from robocomp_dsl.deploy.hosts.placing import candidate_hosts, place_on
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.hosts.rollout import (
    RolloutResult,
    all_changes,
    lock_hosts,
    raise_failures,
    roll_out,
)
from robocomp_dsl.deploy.hosts.router_ports import check_router_ports
from robocomp_dsl.deploy.network.identities import needs_network
from robocomp_dsl.deploy.network.key_checks import check_keys
from robocomp_dsl.deploy.network.key_folder import key_folder
from robocomp_dsl.deploy.network.operator_settings import write_operator_settings
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.model.deployment import Deployment, Host


class Rejected(Exception):
    """The deployment cannot run on its hosts; `findings` say why. Nothing was changed."""

    def __init__(self, findings: Iterable[Diagnostic]) -> None:
        super().__init__("rejected")
        self.findings = list(findings)


class Deployer:
    """Deploys one plan; `say` gets lines of text."""

    def __init__(
        self,
        deployment: Deployment,
        plan: Plan,
        say: Callable[[str], object],
        limits: HostLimits | None = None,
    ) -> None:
        self._deployment = deployment
        self._plan = plan
        self._say = say
        self._limits = limits or HostLimits()
        self._report = Report()
        self._left_behind: list[Host] = []
        self.warnings: list[Diagnostic] = []

    async def up(self) -> RolloutResult:
        """Make the hosts as described. Raises `Rejected` and `HostError`."""
        async with self._checked_fleet() as fleet:
            content = self._describe(fleet)
            checks = await content.check(fleet, self._report)
            spans = host_spans(self._deployment)
            await check_router_ports(fleet, self._deployment, spans, self._report)
            raise_failures(fleet)
            self._reject_errors()
            await lock_hosts(fleet)

            async def copy(fleet: Fleet) -> None:
                await content.copy(fleet, checks, self._say)

            result = await roll_out(
                fleet, content.manifests, copy, self._say, is_complete=content.is_complete(checks)
            )
            self._register(content)
            for name in result.failed:
                component = all_components(content.manifests.values())[name]
                await show_last_lines(fleet, component, self._say)
            if not result.failed:
                await content.collect_garbage(fleet)
        return result

    async def diff(self) -> list[HostChanges]:
        """What `up` would change. Raises `Rejected` and `HostError`."""
        async with self._checked_fleet() as fleet:
            content = self._describe(fleet)
            reports = await fleet.reports()
            raise_failures(fleet)
        return all_changes(content.manifests, reports)

    def _describe(self, fleet: Fleet) -> FleetContent:
        """What the hosts should have."""
        content = FleetContent(self._deployment, self._plan, fleet.facts, self._report)
        self._reject_errors()
        return content

    @asynccontextmanager
    async def _checked_fleet(self) -> AsyncIterator[Fleet]:
        """Connections to the hosts, which can run the deployment. Raises `Rejected`."""
        folder = key_folder(self._deployment.name)
        check_keys(self._deployment, folder, datetime.now(UTC), self._report)
        hosts = candidate_hosts(self._deployment)
        earlier = self._earlier_hosts(hosts)
        async with open_fleet([*hosts, *earlier], self._plan.name, with_facts=True) as fleet:
            self._check_fleet(fleet, hosts, earlier)
            await self._place(fleet)
            cpus = {name: facts.cpus for name, facts in fleet.facts.items()}
            self._report.extend(check_cores(self._deployment, cpus))
            self._reject_errors()
            yield fleet

    def _check_fleet(self, fleet: Fleet, hosts: Iterable[Host], earlier: Iterable[Host]) -> None:
        described = {host.name: host for host in hosts}
        spans = host_spans(self._deployment)
        for name, failure in list(fleet.failures.items()):
            if name in described:
                span = spans.get(name, self._deployment.span)
                self._report.extend([describe_failure(failure, span)])
            else:
                del fleet.failures[name]
                self._left_behind.append(next(h for h in earlier if h.name == name))
                self._say(f"{name}: what runs there is not stopped: {failure.message}")
        for name, facts in fleet.facts.items():
            if host := described.get(name):
                span = spans.get(name, self._deployment.span)
                self._report.extend(check_facts(host, facts, span, self._limits))
        self._reject_errors()

    async def _place(self, fleet: Fleet) -> None:
        """Choose the hosts of components that name none."""
        result = await place_on(fleet, self._deployment, self._plan)
        if result is None:
            return
        self._report.extend(result.findings)
        self._reject_errors()
        self._deployment, self._plan = result.deployment, result.plan
        for line in result.lines:
            self._say(line)

    def _earlier_hosts(self, hosts: Iterable[Host]) -> list[Host]:
        """Hosts on which the deployment ran, and no longer does."""
        known = {host.name for host in hosts}
        entry = next((e for e in registry.registered() if e.name == self._plan.name), None)
        return [host for host in entry.hosts if host.name not in known] if entry else []

    def _reject_errors(self) -> None:
        findings = self._report.sorted()
        if self._report.has_errors:
            raise Rejected(findings)
        self.warnings = [f for f in findings if f.severity is Severity.WARNING]

    def _register(self, content: FleetContent) -> None:
        components = all_components(content.manifests.values())
        order = {process.name: i for i, process in enumerate(self._plan.processes)}
        entry = HostedDeployment.from_components(
            self._plan.name,
            str(self._plan.path.resolve()),
            self._plan.domain,
            # The next `up` tries again to stop what runs on hosts that did not answer.
            (*deployment_hosts(self._deployment), *self._left_behind),
            tuple(sorted(components.values(), key=lambda c: order.get(c.name, -1))),
            time.time(),
        )
        registry.register(entry)
        if needs_network(self._deployment):
            folder = key_folder(self._deployment.name)
            write_operator_settings(self._deployment, self._plan.domain, folder)
