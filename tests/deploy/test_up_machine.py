"""`rcdeploy status` shows the lifecycles and state machines of components."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write
from tests.deploy.generated_components import HEAD
from tests.deploy.rcdeploy_process import RunningProcess, rcdeploy, runtime_folder, start_rcdeploy

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
def app(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[RunningProcess]:
    """A running deployment: one component with a state machine and an emergency, one without."""
    monkeypatch.chdir(tmp_path)
    component(tmp_path / "arm", CDSL, WORKER)
    component(tmp_path / "eye", "Component eye { language Python; };\n", PLAIN)
    (tmp_path / "app.ddsl").write_text(APP)
    with (
        runtime_folder(monkeypatch),
        start_rcdeploy("app.ddsl") as running,
    ):
        running.until("all 2 components are ready", "the left hand is stuck")
        yield running
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0


def test_status_shows_lifecycle_and_active_states(app: RunningProcess) -> None:
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
    assert stuck.endswith("does not answer within 0.5 s")
