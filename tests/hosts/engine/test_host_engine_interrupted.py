"""Rollouts and logs while a deployer dies, or a link is cut."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import threading

import pytest

from robocomp_dsl.deploy.hosts.deployer import Rejected
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import open_fleet
from robocomp_dsl.deploy.hosts.host_engine import run_async
from robocomp_dsl.deploy.hosts.host_logs import HostLogReader, LogRequest, follow_logs
from robocomp_dsl.deploy.hosts.rollout import lock_hosts
from robocomp_dsl.deploy.logs import LogRecord
from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rig.hosts import Hosts
from tests.support.waiting import wait_until

ARM = 'component arm on robot { set serial = "a"; ready within 100 s; };\n'
EYE = "component eye on base { after arm; ready within 100 s; };\n"
COUNTING = """
class SpecificWorker(GenericWorker):
    count = 0
    def initialize(self):
        time.sleep(0.5)
    def compute(self):
        self.count += 1
        self.log.info("count %d", self.count)
"""


@pytest.fixture(scope="module")
def app(module_hosts: Hosts, tmp_path_factory: pytest.TempPathFactory) -> HostedApp:
    module_hosts.start("robot")
    module_hosts.start("base")
    return make_app(tmp_path_factory.mktemp("deployment") / "app", module_hosts, eye=COUNTING)


@pytest.fixture(autouse=True)
def operator(app: HostedApp, monkeypatch: pytest.MonkeyPatch) -> None:
    app.enter(monkeypatch)


@pytest.fixture
def deployed(app: HostedApp) -> HostedApp:
    """`arm` and `eye` run."""
    app.deploy(ARM + EYE)
    return app


def test_host_engine_completes_rollout_of_killed_deployer(app: HostedApp) -> None:
    app.write(ARM + EYE)
    app.make_keys()
    command = [sys.executable, "-m", "robocomp_dsl.cli.rcdeploy", "up", str(app.path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as deployer:
        assert deployer.stdout
        for line in deployer.stdout:
            if line.startswith("arm (robot): ready"):
                break
        deployer.send_signal(signal.SIGKILL)
    before = run_async(read_pids(app))
    assert before["arm"]
    result = app.up()
    assert not result.failed
    after = app.pids()
    assert after["arm"] == before["arm"]
    assert after["eye"]
    assert not app.diff()


async def read_pids(app: HostedApp) -> dict[str, int]:
    """The process of each unit, without the registry, which the killed deployer did not write."""
    hosts = app.hosts_of_deployment()
    async with open_fleet(hosts, "app") as fleet:
        reports = await fleet.reports()
    states = [item for report in reports.values() for item in report.states.items()]
    return {unit.split("-")[-1].split(".")[0]: state.pid for unit, state in states}


def test_host_engine_rejects_second_deployer(deployed: HostedApp) -> None:
    async def deploy_twice() -> None:
        async with open_fleet(deployed.hosts_of_deployment(), "app") as fleet:
            await lock_hosts(fleet)
            with pytest.raises(Rejected) as rejected:
                await deployed.deployer().up()
            assert {f.code.id for f in rejected.value.findings} >= {"RC838"}
            async with open_fleet(deployed.hosts_of_deployment(), "app") as other:
                with pytest.raises(HostError, match="another rcdeploy"):
                    await lock_hosts(other)

    asyncio.run(deploy_twice())
    assert not deployed.up().changes


def test_host_engine_logs_go_on_after_cut_link(deployed: HostedApp) -> None:
    found: list[LogRecord] = []
    errors: list[HostError] = []
    ended = threading.Event()
    base = deployed.hosts.by_name["base"]

    async def follow() -> None:
        readers = [
            HostLogReader(host, "app", LogRequest(["eye"]))
            for host in deployed.hosts_of_deployment()
        ]
        async for record in follow_logs(readers, errors.append):
            found.append(record)
            if ended.is_set():
                return

    thread = threading.Thread(target=lambda: asyncio.run(follow()))
    thread.start()
    try:
        wait_until(lambda: len(counts(found)) > 5, "no logs")
        base.cut_link()
        wait_until(lambda: bool(errors), "the cut link was not noticed")
        lost_at = counts(found)[-1]
        base.restore_link()
        wait_until(lambda: counts(found)[-1] > lost_at + 20, "the logs do not go on")
    finally:
        base.restore_link()
        ended.set()
        thread.join(120)
    numbers = counts(found)
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    assert {record.host for record in found} == {"base"}


def counts(records: list[LogRecord]) -> list[int]:
    return [int(r.text.split()[1]) for r in list(records) if r.text.startswith("count ")]


def test_host_engine_reports_why_component_fails(deployed: HostedApp) -> None:
    worker = deployed.folder / "eye/specificworker.py"
    text = worker.read_text()
    worker.write_text(text.replace("time.sleep(0.5)", 'raise SystemExit("no camera")'))
    deployed.write(ARM + EYE.replace("after", "restart never; after"))
    pids = deployed.pids()
    result = deployed.up()
    assert set(result.failed) == {"eye"}
    assert any("no camera" in line for line in deployed.lines), deployed.lines
    assert deployed.rows()["arm"].pid == pids["arm"]
    worker.write_text(text)
    assert not deployed.up().failed
    assert os.environ["HOME"] == str(deployed.hosts.operator)
