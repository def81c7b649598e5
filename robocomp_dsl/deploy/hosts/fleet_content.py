"""What all hosts of a deployment should have: units, files, Python packages, keys.

In: a deployment, its plan, facts about the hosts. Out: manifests, which need no connection; then
what each host lacks, and the copy.
"""

from __future__ import annotations

import asyncio
import sys
import time
from collections.abc import Callable, Mapping

from robocomp_dsl.deploy.content.collect import collect_garbage
from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.host_content import (
    ContentCheck,
    HostContent,
    check_content,
    copy_content,
    describe_content,
)
from robocomp_dsl.deploy.content.lock import EnvironmentLocker
from robocomp_dsl.deploy.content.wheel_target import choose_target
from robocomp_dsl.deploy.hosts.copying import copy_private_files
from robocomp_dsl.deploy.hosts.description import (
    HostSettings,
    deployment_hosts,
    describe_hosts,
    processes_of,
)
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_checks import format_bytes, host_spans
from robocomp_dsl.deploy.hosts.host_facts import HostFacts
from robocomp_dsl.deploy.hosts.host_network import HostNetwork, host_networks
from robocomp_dsl.deploy.hosts.manifest import HostManifest
from robocomp_dsl.deploy.network.key_folder import key_folder
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.deploy.units import names
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment

PROGRESS_S = 5.0
"""A long copy reports its progress so often."""


class FleetContent:
    """The content of all hosts; problems are in `report`. `manifests` are by name of the host."""

    def __init__(
        self,
        deployment: Deployment,
        plan: Plan,
        facts: Mapping[str, HostFacts],
        report: Report,
    ) -> None:
        self._plan = plan
        self._spans = host_spans(deployment)
        self._span = deployment.span
        self.manifests: dict[str, HostManifest] = {}
        self._trees = describe_trees(deployment, plan, report)
        if report.has_errors:
            return
        self._contents = {
            host.name: self._host_content(deployment, host.name, facts[host.name], report)
            for host in deployment_hosts(deployment)
        }
        if report.has_errors:
            return
        self._networks = host_networks(deployment, plan, key_folder(deployment.name))
        settings = {
            name: HostSettings(
                sys.executable,
                content.runtime.hash,
                {process: each.hash for process, each in content.environments.items()},
                self._networks.get(name, HostNetwork()),
                facts[name].controllers,
            )
            for name, content in self._contents.items()
        }
        self.manifests = describe_hosts(deployment, plan, self._trees, settings, report)

    def _host_content(
        self, deployment: Deployment, host: str, facts: HostFacts, report: Report
    ) -> HostContent:
        target = choose_target(facts)
        assert target is not None  # noqa: S101 - the checks of the hosts require it
        locker = EnvironmentLocker(deployment, self._plan, target, report)
        processes = processes_of(host, deployment, self._plan)
        root = names.root_folder(self._plan.name)
        span = self._spans.get(host, self._span)
        return describe_content(root, target, processes, self._trees, locker, span)

    async def check(self, fleet: Fleet, report: Report) -> dict[str, ContentCheck]:
        """What each host lacks; problems are in `report`. A host that fails is in `fleet`."""
        one_at_a_time = asyncio.Lock()

        async def check(agent: HostAgent) -> ContentCheck | None:
            content = self._contents.get(agent.host.name)
            if content is None:
                return None
            span = self._spans.get(agent.host.name, self._span)
            async with one_at_a_time:  # hosts need the same wheels, which are made once
                return await check_content(agent.connection, content, span, report)

        return {host: found for host, found in (await fleet.each(check)).items() if found}

    def is_complete(self, checks: Mapping[str, ContentCheck]) -> bool:
        """Whether no host lacks anything."""
        return all(check.is_complete for check in checks.values())

    async def copy(
        self, fleet: Fleet, checks: Mapping[str, ContentCheck], say: Callable[[str], object]
    ) -> None:
        """Copy and install what hosts lack, and the keys. A host that fails is in `fleet`."""

        async def copy(agent: HostAgent) -> None:
            name = agent.host.name
            if (check := checks.get(name)) is None or check.is_complete:
                return
            result = await copy_content(agent.connection, check, _Progress(name, say).report)
            files = f"{result.files} file{'s' * (result.files != 1)}"
            size = format_bytes(result.bytes)
            say(f"{name}: copied {files}, {size} in {result.seconds:.1f} s")

        await fleet.each(copy)
        await copy_private_files(fleet, self._plan.name, self._networks)

    async def collect_garbage(self, fleet: Fleet) -> None:
        """Delete what no stored version uses."""

        async def collect(agent: HostAgent) -> None:
            if content := self._contents.get(agent.host.name):
                path = content.target.path
                await collect_garbage(agent.connection, content.root, python=path)

        await fleet.each(collect)


class _Progress:
    """Reports the progress of a long copy."""

    def __init__(self, host: str, say: Callable[[str], object]) -> None:
        self._host = host
        self._say = say
        self._next = time.monotonic() + PROGRESS_S

    def report(self, copied: int, total: int) -> None:
        if copied < total and time.monotonic() > self._next:
            self._next = time.monotonic() + PROGRESS_S
            self._say(f"{self._host}: {format_bytes(copied)} of {format_bytes(total)}")
