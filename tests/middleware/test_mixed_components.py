"""Generated components whose ports are on several middlewares, in one deployment."""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write
from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces
from robocomp_dsl.runtime.middleware.registry import (
    BUILT_IN,
    capabilities_of,
    description_of,
    missing_modules,
)
from tests.deploy.rcdeploy_process import (
    RunningProcess,
    rcdeploy,
    runtime_folder,
    start_rcdeploy,
)
from tests.support.waiting import wait_until

IDSL = """
module Mixed
{
    interface Sum { int add(int a, int b); };
    interface Product { int multiply(int a, int b); };
    interface Ticks { void tick(int number); };
};
"""
MATHS = """
import "Mixed.idsl";
Component maths
{
    Communications
    {
        implements Sum(zenoh, local), Product(local);
        publishes Ticks(local, zenoh);
    };
    language Python;
};
"""
ASKER = """
import "Mixed.idsl";
Component asker
{
    Communications { requires Sum(local), Product(local); subscribesTo Ticks(zenoh); };
    language Python;
};
"""
WORKERS = {
    "maths": """
from maths_generated.genericworker import GenericWorker
class SpecificWorker(GenericWorker):
    def Sum_add(self, a, b):
        return a + b
    def Product_multiply(self, a, b):
        return a * b
    def compute(self):
        self.ticks_proxy.tick(7)
""",
    "asker": """
from asker_generated.genericworker import GenericWorker
class SpecificWorker(GenericWorker):
    ticks = 0
    def Ticks_tick(self, number):
        self.ticks += 1
    def compute(self):
        if self.ticks:
            results = self.sum_proxy.add(2, 3), self.product_proxy.multiply(2, 3)
            print(self.name, "has", *results, flush=True)
""",
}
APP = """
import "maths/maths.cdsl";
import "asker/asker.cdsl";
Deployment mixed
{
    component maths { ready within 200 s; };
    component asker { after maths; ready within 200 s; };
    component second : asker { after maths; ready within 200 s; };
    connect second.Sum -> maths.Sum over zenoh;
};
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Both components, generated."""
    monkeypatch.chdir(tmp_path)
    for name, text in (("maths", MATHS), ("asker", ASKER)):
        path = tmp_path / name
        path.mkdir()
        (path / "Mixed.idsl").write_text(IDSL)
        (path / f"{name}.cdsl").write_text(text)
        report = Report()
        component = check_cdsl(path / f"{name}.cdsl", Workspace(), report)
        assert component
        assert not report.has_errors
        write(path, plan(component))
        (path / "specificworker.py").write_text(WORKERS[name])
    (tmp_path / "app.ddsl").write_text(APP)
    return tmp_path


def connecting_middlewares() -> list[str]:
    """Installed middlewares that connect our components in several processes."""
    names = [name for name in BUILT_IN if not missing_modules(description_of(name))]  # type: ignore[arg-type]
    found = []
    for name in names:
        able = capabilities_of(name)
        if able.between_processes and able.services and able.topics and not able.valid_names:
            found.append(name)
    return found


def test_deployment_of_mixed_components_uses_marks_and_connections(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with runtime_folder(monkeypatch), start_rcdeploy("app.ddsl") as running:
        running.until("all 3 components are ready", "asker has 5 6", "second has 5 6")
        domain = json.loads(rcdeploy("status", "mixed", "--format", "json").stdout)["domain"]
        with DomainClient(domain) as client:
            ports = {
                port.name: port.middleware for port in client.component("maths").getInfo().ports
            }
        assert ports["Sum"] == "zenoh, local"
        assert ports["Ticks"] == "local, zenoh"
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0


def test_generated_component_serves_every_middleware_chosen_at_start(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One process, unchanged code: `--middleware PORT=M[,M]`."""
    names = connecting_middlewares()
    assert {"local", "zenoh"} <= set(names)
    every = ",".join(names)
    choice = [word for port in ("Sum", "Ticks") for word in ("--middleware", f"{port}={every}")]
    with runtime_folder(monkeypatch):
        domain = f"mixed-{os.getpid()}"
        start = [sys.executable, "main.py", "--domain", domain]
        with RunningProcess(*start, *choice, where=folder / "maths") as server:
            server.until("running every")
            for name in names:
                client_choice = [f"Sum={name}", f"Ticks={name}", "Product=local"]
                options = [word for text in client_choice for word in ("--middleware", text)]
                caller = [sys.executable, "main.py", "--domain", domain, "--name", f"on_{name}"]
                with RunningProcess(*caller, *options, where=folder / "asker") as client:
                    client.until(f"on_{name} has 5 6")
                    client.process.send_signal(signal.SIGTERM)
                    assert client.end() == 0
            server.process.send_signal(signal.SIGTERM)
            assert server.end() == 0


def test_client_receives_publisher_that_starts_later_on_another_middleware(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with runtime_folder(monkeypatch):
        domain = f"late-{os.getpid()}"
        interfaces = load_generated_interfaces(folder / "maths")
        received: list[int] = []
        with DomainClient(domain) as client:
            client.subscribe(interfaces.TICKS, "maths", "Ticks", {"tick": received.append})
            start = [sys.executable, "main.py", "--domain", domain]
            options = ["--middleware", "Ticks=local"]
            with RunningProcess(*start, *options, where=folder / "maths") as server:
                wait_until(lambda: received)
                server.process.send_signal(signal.SIGTERM)
                assert server.end() == 0
        assert set(received) == {7}
