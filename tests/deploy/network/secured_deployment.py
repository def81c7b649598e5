"""A deployment on two hosts, which are addresses of loopback: keys, routers, component processes.

`boss` on the host `left` uses `worker` on the host `right` in every way that components have.
"""

from __future__ import annotations

import contextlib
import socket
import sys
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl, check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.network.access_rules import AccessRules, access_rules
from robocomp_dsl.deploy.network.identities import common_name, identities, router_name, used_hosts
from robocomp_dsl.deploy.network.key_folder import KeyFolder, key_folder
from robocomp_dsl.deploy.network.operator_settings import write_operator_settings
from robocomp_dsl.deploy.network.port_uses import AddedConnection
from robocomp_dsl.deploy.network.router_plan import component_settings, router_settings
from robocomp_dsl.deploy.network.update_keys import update_keys
from robocomp_dsl.deploy.plan import plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan as generation_plan
from robocomp_dsl.generate.write import write
from robocomp_dsl.model.deployment import Deployment, Host
from robocomp_dsl.runtime.presence.network_settings import NETWORK_VARIABLE
from tests.deploy.rcdeploy_process import RunningProcess

IDSL = """
module Tasks
{
    exception Unfit { string reason; };
    interface Job
    {
        int twice(int x) throws Unfit;
        [command] void start(string what);
        [command] void pause();
    };
    interface News { void news(string text); };
    interface State { void state(string text); };
};
"""
BOSS = """
import "Tasks.idsl";
Component boss
{
    Communications { requires Job; subscribesTo News, State; };
    language Python;
    period 20;
};
"""
WORKER = """
import "Tasks.idsl";
Component worker
{
    Communications { implements Job; publishes News, State; };
    language Python;
    parameters "worker.pdsl";
};
"""
TICKER = """
import "Tasks.idsl";
import "Clock.idsl";
Component ticker
{
    Communications { implements Job; publishes News, State, Clock; };
    language Python;
    period 10;
};
"""
PARAMETERS = "ComponentParams worker { gain int 1 0:100 live; };\n"
BOSS_CODE = """
from boss_generated.genericworker import GenericWorker
class SpecificWorker(GenericWorker):
    commands = 0
    def initialize(self):
        self.heard = set()
    def compute(self):
        if self.job_proxy.twice(4) == 8:
            self.once("calls the worker")
        self.job_proxy.start("dig")
    def once(self, text):
        if text not in self.heard:
            self.heard.add(text)
            self.log.info("boss %s", text)
    def News_news(self, text):
        self.once(f"hears {text}")
    def State_state(self, text):
        self.once(f"sees {text}")
    def publisher_lost(self, port, publisher):
        self.log.info("boss lost %s", publisher)
"""
WORKER_CODE = """
from worker_generated.genericworker import GenericWorker
class SpecificWorker(GenericWorker):
    started = False
    def initialize(self):
        self.state_proxy.state("latched state")
    def compute(self):
        self.news_proxy.news("reliable news")
    def Job_twice(self, x):
        return 2 * x
    def Job_start(self, what):
        if not self.started:
            self.started = True
            self.log.info("worker starts to %s", what)
    def Job_pause(self):
        pass
"""
APP = """
import "boss/boss.cdsl";
import "worker/worker.cdsl";
Deployment site
{{
    host left {{ address "127.0.0.2:22"; port {left}; }};
    host right {{ address "127.0.0.3:22"; port {right}; }};
    component worker on right;
    component boss on left;
    connect worker.News -> boss.News {{ reliable; liveliness 1 s; }};
    connect worker.State -> boss.State {{ latched; }};
}};
"""


CLOCK_APP = """
import "boss/boss.cdsl";
import "ticker/ticker.cdsl";
Deployment timed
{{
    host left {{ address "127.0.0.2:22"; port {left}; }};
    host right {{ address "127.0.0.3:22"; port {right}; }};
    component ticker on right;
    component boss on left {{ prefix lab; }};
    clock sim from ticker CLOCK_KIND;
    CONNECTION
}};
"""


def free_ports(number: int) -> list[int]:
    """TCP ports of all loopback addresses that are free now."""
    with contextlib.ExitStack() as stack:
        probes = [stack.enter_context(socket.socket()) for _ in range(number)]
        for probe in probes:
            probe.bind(("0.0.0.0", 0))
        return [probe.getsockname()[1] for probe in probes]


def generate(folder: Path, name: str, cdsl: str, code: str, pdsl: str = "") -> None:
    """Generate a component that imports `Tasks.idsl`, with the code of its worker."""
    path = folder / name
    path.mkdir(exist_ok=True)
    (path / "Tasks.idsl").write_text(IDSL)
    (path / f"{name}.cdsl").write_text(cdsl)
    if pdsl:
        (path / f"{name}.pdsl").write_text(pdsl)
    report = Report()
    component = check_cdsl(path / f"{name}.cdsl", Workspace(), report)
    messages = [each.message for each in report.sorted()]
    assert component, messages
    assert not report.has_errors, messages
    write(path, generation_plan(component))
    (path / "specificworker.py").write_text(code)


class SecuredDeployment:
    """Keys and settings of a deployment below `folder`; `domain` is its domain."""

    def __init__(self, folder: Path, app: str = APP) -> None:
        left, right = free_ports(2)
        path = folder / "app.ddsl"
        path.write_text(app.format(left=left, right=right))
        report = Report()
        deployment = check_ddsl(path, Workspace(), report)
        messages = [each.message for each in report.sorted()]
        assert deployment, messages
        assert not report.has_errors, messages
        self.deployment: Deployment = deployment
        self.domain = f"{deployment.name}-test"
        self.keys: KeyFolder = key_folder(deployment.name)
        update_keys(deployment.name, identities(deployment), self.keys, datetime.now(UTC))
        self.write_settings()

    @property
    def hosts(self) -> tuple[Host, ...]:
        return used_hosts(self.deployment)

    def rules(self, added: Sequence[AddedConnection] = ()) -> AccessRules:
        return access_rules(self.deployment, self.domain, added)

    def write_settings(self, rules: AccessRules | None = None) -> None:
        """Write the settings of all routers and components into the folder of the keys."""
        for host in self.hosts:
            text = router_settings(self.deployment, host, rules or self.rules())
            self.router_file(host).write_text(text)
        for instance in self.deployment.instances:
            text = component_settings(self.deployment, instance)
            self.settings_file(instance.full_name).write_text(text)
        write_operator_settings(self.deployment, self.domain, self.keys)

    def router_file(self, host: Host) -> Path:
        return self.keys.path / f"{router_name(host)}.json"

    def settings_file(self, name: str) -> Path:
        return self.keys.path / f"{common_name(name)}.json".replace("/", "%2F")

    def start_router(self, host: Host) -> RunningProcess:
        """Start the router of a host; returns when it listens."""
        module = "robocomp_dsl.runtime.router"
        router = RunningProcess(sys.executable, "-m", module, str(self.router_file(host)))
        router.until("listens at")
        return router

    @contextlib.contextmanager
    def routers(self) -> Iterator[list[RunningProcess]]:
        """The routers of all hosts, which are connected to each other.

        A test may replace one in the list; all that are in it at the end are ended.
        """
        running: list[RunningProcess] = []
        try:
            running += [self.start_router(host) for host in self.hosts]
            yield running
        finally:
            for router in running:
                router.__exit__(None, None, None)

    def start(self, name: str, monkeypatch: pytest.MonkeyPatch, *options: str) -> RunningProcess:
        """Start a component as the plan of the deployment says."""
        planned = plan(
            self.deployment,
            name=self.deployment.name,
            domain=self.domain,
            interpreter=sys.executable,
        )
        process = next(each for each in planned.processes if each.name == name)
        with monkeypatch.context() as patch:
            patch.setenv(NETWORK_VARIABLE, str(self.settings_file(name)))
            return RunningProcess(*process.argv, *options, where=process.cwd)
