"""`rcdeploy status` tells what components themselves tell: life cycles and state machines."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write
from tests.deploy.deploy_process import Running, runtime_folder
from tests.deploy.deploy_robot import HEAD

PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"
CDSL = 'Component arm { language Python; period 10; statemachine "arm.smdsl"; };\n'
SMDSL = """
arm
{
    initial_state moving;
    states resting;
    transitions { moving => resting on enough; resting => moving on again; };
};
:moving parallel { states left, right; };
:left
{
    initial_state up;
    states down;
    transitions { up => down on lower; down => up on lift; };
};
"""
WORKER = """
class SpecificWorker(GenericWorker):
    def on_enter_up(self):
        self.declare_emergency("the left hand is stuck")
"""
PLAIN = "\nclass SpecificWorker(GenericWorker):\n    pass\n"
APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app { component arm { ready within 200 s; }; component eye { ready within 200 s; }; };
"""


def rcdeploy(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip


def component(folder: Path, cdsl: str, worker: str) -> None:
    path = folder / f"{folder.name}.cdsl"
    folder.mkdir()
    path.write_text(cdsl)
    (folder / "arm.smdsl").write_text(SMDSL)
    report = Report()
    model = check_cdsl(path, Workspace(), report)
    assert model
    assert not report.has_errors, [finding.message for finding in report]
    write(folder, plan(model))
    (folder / "specificworker.py").write_text(HEAD.format(name=folder.name) + worker)


@pytest.fixture
def app(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Running]:
    """A running deployment: one component with a machine that is in trouble, one without."""
    monkeypatch.chdir(tmp_path)
    component(tmp_path / "arm", CDSL, WORKER)
    component(tmp_path / "eye", "Component eye { language Python; };\n", PLAIN)
    (tmp_path / "app.ddsl").write_text(APP)
    with (
        runtime_folder(monkeypatch),
        Running(sys.executable, "-c", PROGRAM, "app.ddsl") as running,
    ):
        running.until("all 2 components are ready", "the left hand is stuck")
        yield running
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0


def test_life_and_all_active_states_are_shown(app: Running) -> None:
    shown = rcdeploy("status", "app")
    assert shown.returncode == 0, shown.stderr
    head, arm, eye = shown.stdout.splitlines()[1:]
    assert head.split()[:5] == ["NAME", "STATE", "LIFE", "MACHINE", "PID"]
    assert " emergency  moving, left, up, right " in arm
    assert arm.endswith("the left hand is stuck")
    assert " compute    -  " in eye
    data = json.loads(rcdeploy("status", "app", "--format", "json").stdout)["components"]
    assert [(entry["life"], entry["machine"]) for entry in data] == [
        ("emergency", ["moving", "left", "up", "right"]),
        ("compute", []),
    ]
    os.kill(data[1]["pid"], signal.SIGSTOP)
    try:
        stuck = rcdeploy("status", "app").stdout.splitlines()[-1]
    finally:
        os.kill(data[1]["pid"], signal.SIGCONT)
    assert stuck.endswith("does not answer within 1 s")
