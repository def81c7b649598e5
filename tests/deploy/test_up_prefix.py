"""Copies of a component under prefixes, in processes: who finds whom, and what it is called."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.deploy_process import Running, runtime_folder
from tests.deploy.deploy_robot import build

PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"
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


def rcdeploy(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip


@pytest.fixture
def app(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Running]:
    monkeypatch.chdir(tmp_path)
    build(tmp_path, {"arm": ARM, "eye": EYE})
    lab = tmp_path / "arm" / "contexts" / "lab" / "left"
    lab.mkdir(parents=True)
    (lab / "arm.yaml").write_text("serial: of left\n")
    (tmp_path / "app.ddsl").write_text(APP)
    with (
        runtime_folder(monkeypatch),
        Running(sys.executable, "-c", PROGRAM, "app.ddsl") as running,
    ):
        running.until("all 4 components are ready", "left/near sees", "left/far sees")
        yield running
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0


def test_each_finds_what_is_under_its_prefix(app: Running) -> None:
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
