"""Checks, describes and rolls out a deployment over hosts.

In: a checked deployment and its plan. Out: findings, differences, or running units. All checks on
all hosts come before the first change.
"""

from __future__ import annotations

import sys
import time
from collections.abc import AsyncIterator, Callable, Iterable, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass
from datetime import UTC, datetime

from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts import registry
from robocomp_dsl.deploy.hosts.copying import copy_private_files, copy_trees
from robocomp_dsl.deploy.hosts.description import (
    HostSettings,
    all_components,
    deployment_hosts,
    describe_hosts,
)
from robocomp_dsl.deploy.hosts.differences import HostChanges
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import Fleet, open_fleet
from robocomp_dsl.deploy.hosts.host_engine import show_last_lines
from robocomp_dsl.deploy.hosts.host_network import HostNetwork, host_networks
from robocomp_dsl.deploy.hosts.manifest import HostManifest
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.hosts.rollout import (
    RolloutResult,
    all_changes,
    lock_hosts,
    raise_failures,
    roll_out,
)
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


@dataclass(frozen=True, slots=True)
class _Content:
    """What the hosts should have, by the names of hosts, and of processes for `trees`."""

    manifests: dict[str, HostManifest]
    trees: dict[str, ContentTree]
    networks: dict[str, HostNetwork]


class Deployer:
    """Deploys one plan; `say` gets lines of text."""

    def __init__(self, deployment: Deployment, plan: Plan, say: Callable[[str], object]) -> None:
        self._deployment = deployment
        self._plan = plan
        self._say = say
        self._report = Report()
        self._trees: dict[str, ContentTree] = {}
        self.warnings: list[Diagnostic] = []

    async def up(self) -> RolloutResult:
        """Make the hosts as described. Raises `Rejected` and `HostError`."""
        async with self._checked_fleet() as fleet:
            content = self._describe()
            await lock_hosts(fleet)

            async def copy(fleet: Fleet) -> None:
                await copy_trees(fleet, content.manifests, content.trees, self._say)
                await copy_private_files(fleet, self._plan.name, content.networks)

            result = await roll_out(fleet, content.manifests, copy, self._say)
            self._register(content.manifests)
            for name in result.failed:
                component = all_components(content.manifests.values())[name]
                await show_last_lines(fleet, component, self._say)
        return result

    async def diff(self) -> list[HostChanges]:
        """What `up` would change. Raises `Rejected` and `HostError`."""
        async with self._checked_fleet() as fleet:
            content = self._describe()
            reports = await fleet.reports()
            raise_failures(fleet)
        return all_changes(content.manifests, reports)

    def _check_description(self) -> None:
        """Find what is wrong with the description, before any connection is opened."""
        folder = key_folder(self._deployment.name)
        check_keys(self._deployment, folder, datetime.now(UTC), self._report)
        self._trees = describe_trees(self._deployment, self._plan, self._report)
        self._reject_errors()

    def _describe(self) -> _Content:
        """What the hosts should have."""
        folder = key_folder(self._deployment.name)
        networks = host_networks(self._deployment, self._plan, folder)
        settings = {
            host.name: HostSettings(
                sys.executable, sys.executable, network=networks.get(host.name, HostNetwork())
            )
            for host in deployment_hosts(self._deployment)
        }
        described = describe_hosts(
            self._deployment, self._plan, self._trees, settings, self._report
        )
        self._reject_errors()
        return _Content(described, self._trees, networks)

    @asynccontextmanager
    async def _checked_fleet(self) -> AsyncIterator[Fleet]:
        """Connections to the hosts, which can run the deployment. Raises `Rejected`."""
        self._check_description()
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
        order = {process.name: i for i, process in enumerate(self._plan.processes)}
        ordered = tuple(sorted(components.values(), key=lambda c: order.get(c.name, -1)))
        entry = HostedDeployment.from_components(
            self._plan.name,
            str(self._plan.path.resolve()),
            self._plan.domain,
            hosts,
            ordered,
            time.time(),
        )
        registry.register(entry)
        if needs_network(self._deployment):
            folder = key_folder(self._deployment.name)
            write_operator_settings(self._deployment, self._plan.domain, folder)
