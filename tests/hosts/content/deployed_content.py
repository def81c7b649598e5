"""The content of a deployment on one simulated host, step by step."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import TypeVar

from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.host_content import (
    ContentCheck,
    HostContent,
    check_content,
    copy_content,
    describe_content,
)
from robocomp_dsl.deploy.content.lock import EnvironmentLocker
from robocomp_dsl.deploy.content.transfer import CopyResult
from robocomp_dsl.deploy.content.wheel_target import choose_target
from robocomp_dsl.deploy.hosts.connection import HostConnection, connect
from robocomp_dsl.deploy.hosts.host_facts import fetch_facts
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.model.deployment import Deployment, Host
from tests.deploy.content.workspace_files import ROOT
from tests.hosts.rig.machine import SimulatedHost

Result = TypeVar("Result")


class DeployedContent:
    """All components of a deployment on one host, whatever host they name."""

    def __init__(self, robot: SimulatedHost, deployment: Deployment, plan: Plan) -> None:
        self.robot = robot
        self.deployment = deployment
        self.plan = plan
        self.report = Report()
        self.content: HostContent

    @property
    def findings(self) -> list[Diagnostic]:
        """What was found so far."""
        return self.report.sorted()

    def check(self) -> ContentCheck:
        """What the host lacks."""
        return self._with_connection(self._check)

    def up(self) -> CopyResult:
        """Copy what the host lacks."""

        async def work(connection: HostConnection) -> CopyResult:
            check = await self._check(connection)
            assert not self.report.has_errors, [str(f.message) for f in self.findings]
            return await copy_content(connection, check)

        return self._with_connection(work)

    def _with_connection(self, work: Callable[[HostConnection], Awaitable[Result]]) -> Result:
        async def run() -> Result:
            connection = await connect(Host("robot", self.robot.address, self.robot.user))
            try:
                return await work(connection)
            finally:
                await connection.close()

        return asyncio.run(run())

    async def _check(self, connection: HostConnection) -> ContentCheck:
        target = choose_target(await fetch_facts(connection))
        assert target is not None
        trees = describe_trees(self.deployment, self.plan, self.report)
        locker = EnvironmentLocker(self.deployment, self.plan, target, self.report)
        span = self.deployment.span
        self.content = describe_content(ROOT, target, self.plan.processes, trees, locker, span)
        return await check_content(connection, self.content, span, self.report)
