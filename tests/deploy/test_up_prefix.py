"""Copies of a component under prefixes: their names, and the servers they find."""

from __future__ import annotations

import json
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.generated_components import generate_components
from tests.deploy.rcdeploy_process import RunningProcess, rcdeploy, runtime_folder, start_rcdeploy

ARM = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        self.log.info("%s begins with %s", self.name, self.params.serial)
    def Laser_getLaserData(self):
        return TLaserData([TData(0.5, float(self.params.serial == "of left"))])
"""
EYE = """
class SpecificWorker(GenericWorker):
    def compute(self):
        self.log.info("%s sees %g", self.name, self.laser_proxy.getLaserData()[0].dist)
        self.set_period(0)
"""
APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    component arm { prefix left; context "lab"; ready within 200 s; };
    component other : arm { prefix "right/hand"; set serial = "of right"; ready within 200 s; };
    component near : eye { prefix left; after arm; ready within 200 s; };
    component far : eye { prefix left; after other; ready within 200 s; };
    connect far.Laser -> other.Laser;
};
"""


@pytest.fixture
def app(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[RunningProcess]:
    monkeypatch.chdir(tmp_path)
    generate_components(tmp_path, {"arm": ARM, "eye": EYE})
    lab = tmp_path / "arm" / "contexts" / "lab" / "left"
    lab.mkdir(parents=True)
    (lab / "arm.yaml").write_text("serial: of left\n")
    (tmp_path / "app.ddsl").write_text(APP)
    with (
        runtime_folder(monkeypatch),
        start_rcdeploy("app.ddsl") as running,
    ):
        running.until("all 4 components are ready", "left/near sees", "left/far sees")
        yield running
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0


def test_components_find_servers_under_their_prefix(app: RunningProcess) -> None:
    assert app.has("left/arm begins with of left")
    assert app.has("right/hand/other begins with of right")
    assert app.has("left/near sees 1")
    assert app.has("left/far sees 0")
    rows = json.loads(rcdeploy("status", "app", "--format", "json").stdout)["components"]
    assert [(row["name"], row["life"]) for row in rows] == [
        ("left/arm", "compute"),
        ("right/hand/other", "compute"),
        ("left/near", "compute"),
        ("left/far", "compute"),
    ]
    for name in ("arm", "left/arm"):
        assert rcdeploy("param", "get", "app", name, "serial").stdout == "of left\n"
        lines = rcdeploy("logs", "app", "-c", name).stdout.splitlines()
        assert lines
        assert all("left/arm" in line for line in lines)
    wrong = rcdeploy("logs", "app", "-c", "nera")
    assert wrong.returncode == 1
    assert "there is no component `nera` in the deployment" in wrong.stderr
