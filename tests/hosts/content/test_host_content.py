"""Trees and environments on simulated hosts without internet: real OpenSSH, real uv."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TypeVar

import pytest

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
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.model.deployment import Host
from tests.deploy.content.workspace_files import ROOT, check, write_component
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost

Result = TypeVar("Result")
APP = 'import "arm/arm.cdsl";\nDeployment app { component arm; };\n'
MAIN = "import numpy, zenoh, yaml\nimport robocomp_dsl.runtime\nprint('ready', numpy.zeros(3))\n"
ARM_FILES = {"main.py": MAIN, "etc/config.yaml": "rate: 20\n"}


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    """A host with a Python and nothing else of this project."""
    host = module_hosts.start("robot", checkout=False, disk_bytes=1_000_000_000)
    module_hosts.trust()
    return host


@pytest.fixture(autouse=True)
def caches(operator: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The operator's home, with wheels in a cache that all tests of the machine share."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(operator.parent / "cache"))


def with_connection(
    robot: SimulatedHost, work: Callable[[HostConnection], Awaitable[Result]]
) -> Result:
    async def run() -> Result:
        connection = await connect(Host("robot", robot.address, robot.user))
        try:
            return await work(connection)
        finally:
            await connection.close()

    return asyncio.run(run())


class Deployed:
    """A deployment of `arm` to a host, step by step."""

    def __init__(self, robot: SimulatedHost, folder: Path, **files: str) -> None:
        self.robot = robot
        write_component(folder, "arm", {**ARM_FILES, **files})
        self.deployment, self.plan = check(folder / "app.ddsl", APP)
        self.report = Report()

    @property
    def findings(self) -> list[Diagnostic]:
        return self.report.sorted()

    def check(self) -> ContentCheck:
        return with_connection(self.robot, self._check)

    def up(self) -> CopyResult:
        async def work(connection: HostConnection) -> CopyResult:
            check = await self._check(connection)
            assert not self.report.has_errors, [str(f.message) for f in self.findings]
            return await copy_content(connection, check)

        return with_connection(self.robot, work)

    def run(self) -> str:
        """The output of the component on the host."""
        content = self.content
        tree = content.trees["arm"]
        python = f"{self.robot.home_path}/{content.python_of('arm')}"
        folder = f"{self.robot.home_path}/{ROOT}/trees/{tree.hash}/{tree.working_folder}"
        return str(self.robot.run([python, f"{folder}/main.py"]).stdout)

    async def _check(self, connection: HostConnection) -> ContentCheck:
        facts = await fetch_facts(connection)
        target = choose_target(facts)
        assert target is not None
        trees = describe_trees(self.deployment, self.plan, self.report)
        locker = EnvironmentLocker(self.deployment, self.plan, target, self.report)
        span = self.deployment.span
        self.content: HostContent = describe_content(
            ROOT, target, self.plan.processes, trees, locker, span
        )
        return await check_content(connection, self.content, span, self.report)


def test_host_content_installs_without_internet_and_copies_differences(
    robot: SimulatedHost, tmp_path: Path
) -> None:
    import time

    app = Deployed(robot, tmp_path)
    t = time.time()
    first = app.up()
    print("first", time.time() - t, first)
    assert first.trees == 1
    assert first.bytes > 20_000_000
    assert app.run().startswith("ready [0. 0. 0.]")
    t = time.time()
    assert app.check().is_complete
    print("second", time.time() - t)
    (tmp_path / "arm/etc/config.yaml").write_text("rate: 21\n")
    t = time.time()
    changed = app.up()
    print("changed", time.time() - t, changed)
    assert (changed.files, changed.bytes, changed.trees) == (1, len("rate: 21\n"), 1)
    assert app.run().startswith("ready")
