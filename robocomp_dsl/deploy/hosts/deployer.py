"""Checks, describes and rolls out a deployment over hosts.

In: a checked deployment and its plan. Out: findings, differences, or running units. All checks on
all hosts come before the first change.
"""

from __future__ import annotations

import sys
import time
from collections.abc import AsyncIterator, Callable, Iterable, Mapping
from contextlib import asynccontextmanager

from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts import registry
from robocomp_dsl.deploy.hosts.copying import copy_trees
from robocomp_dsl.deploy.hosts.description import (
    HostSettings,
    all_components,
    deployment_hosts,
    describe_hosts,
)
from robocomp_dsl.deploy.hosts.differences import HostChanges
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import Fleet, open_fleet
from robocomp_dsl.deploy.hosts.manifest import HostManifest
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.hosts.rollout import (
    RolloutResult,
    all_changes,
    lock_hosts,
    raise_failures,
    roll_out,
)
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

    def __init__(self, deployment: Deployment, plan: Plan, say: Callable[[str], object]) -> None:
        self._deployment = deployment
        self._plan = plan
        self._say = say
        self._report = Report()
        self.warnings: list[Diagnostic] = []

    async def up(self) -> RolloutResult:
        """Make the hosts as described. Raises `Rejected` and `HostError`."""
        described, trees = self._describe()
        async with self._checked_fleet() as fleet:
            await lock_hosts(fleet)

            async def copy(fleet: Fleet) -> None:
                await copy_trees(fleet, described, trees)

            result = await roll_out(fleet, described, copy, self._say)
            self._register(described)
        return result

    async def diff(self) -> list[HostChanges]:
        """What `up` would change. Raises `Rejected` and `HostError`."""
        described, _ = self._describe()
        async with self._checked_fleet() as fleet:
            reports = await fleet.reports()
            raise_failures(fleet)
        return all_changes(described, reports)

    def _describe(self) -> tuple[dict[str, HostManifest], dict[str, ContentTree]]:
        files = {i.full_name: i.files for i in self._deployment.instances}
        trees = describe_trees(self._deployment, self._plan, self._report, files)
        settings = {
            host.name: HostSettings(sys.executable, sys.executable)
            for host in deployment_hosts(self._deployment)
        }
        described = describe_hosts(self._deployment, self._plan, trees, settings, self._report)
        self._reject_errors()
        return described, trees

    @asynccontextmanager
    async def _checked_fleet(self) -> AsyncIterator[Fleet]:
        """Connections to the hosts, which can run the deployment. Raises `Rejected`."""
        hosts = deployment_hosts(self._deployment)
        async with open_fleet([*hosts, *self._earlier_hosts(hosts)], self._plan.name) as fleet:
            described = {host.name: host for host in hosts}
            for name, failure in list(fleet.failures.items()):
                if name in described:
                    self._report.extend([self._finding(described[name], failure)])
                else:
                    del fleet.failures[name]
                    self._say(f"{name}: what runs there is not stopped: {failure.message}")
            self._reject_errors()
            yield fleet

    def _earlier_hosts(self, hosts: Iterable[Host]) -> list[Host]:
        """Hosts on which the deployment ran, and no longer does."""
        known = {host.name for host in hosts}
        entry = next((e for e in registry.registered() if e.name == self._plan.name), None)
        return [host for host in entry.hosts if host.name not in known] if entry else []

    def _finding(self, host: Host, failure: HostError) -> Diagnostic:
        span = host.span or self._deployment.span
        return Diagnostic(failure.code, span, failure.message, help=failure.help)

    def _reject_errors(self) -> None:
        findings = self._report.sorted()
        if self._report.has_errors:
            raise Rejected(findings)
        self.warnings = [f for f in findings if f.code.severity is Severity.WARNING]

    def _register(self, described: Mapping[str, HostManifest]) -> None:
        hosts = deployment_hosts(self._deployment)
        components = all_components(described.values())
        ordered = tuple(components[process.name] for process in self._plan.processes)
        entry = HostedDeployment.from_components(
            self._plan.name,
            str(self._plan.path.resolve()),
            self._plan.domain,
            hosts,
            ordered,
            time.time(),
        )
        registry.register(entry)
