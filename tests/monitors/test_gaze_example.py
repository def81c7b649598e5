"""The example of `docs/how-to/monitors.md`: a head follows a face, and looks around without one."""

from __future__ import annotations

import importlib.util
import sys
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.check.passes import check_cdsl, check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.plan import plan as plan_deployment
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write
from robocomp_dsl.monitors.class_check import check_monitor_class
from robocomp_dsl.monitors.monitor_finding import MonitoredOperation
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors
from tests.docs.blocks import ROOT, blocks
from tests.docs.session import Session
from tests.docs.test_tutorials import environment
from tests.monitors.manual_clock import ManualClock
from tests.support.waiting import wait_until

PAGE = ROOT / "docs" / "how-to" / "monitors.md"
__all__ = ["environment"]  # a fixture
COMPONENTS = ("face_detector", "explorer", "head_control")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The files of the page, with the generated components."""
    for block in blocks(PAGE):
        if block.verb == "file":
            path = tmp_path / block.argument
            path.parent.mkdir(exist_ok=True)
            path.write_text(block.text)
    for name in COMPONENTS:
        report = Report()
        workspace = Workspace([tmp_path], environ={})
        component = check_cdsl(tmp_path / name / f"{name}.cdsl", workspace, report)
        assert component is not None
        assert not list(report)
        write(tmp_path / name, plan(component))
        monkeypatch.syspath_prepend(str(tmp_path / name))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def create_runner(folder: Path) -> Iterator[Callable[..., Runner]]:
    """A function that creates a component of the example with a clock that stands still."""
    domain = f"test-{uuid.uuid4().hex[:12]}"
    runners: list[Runner] = []

    def create(name: str, **settings: Any) -> Runner:
        module_name = f"{name}_specificworker"
        path = folder / name / "specificworker.py"
        spec = importlib.util.spec_from_file_location(module_name, path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        worker = module.SpecificWorker
        params = worker.SPEC.parameters.load()
        settings = {"domain": domain, "middleware": "inproc", **settings}
        runners.append(Runner(worker, params, RunSettings(**settings), ManualClock()))
        return runners[-1]

    yield create
    for runner in runners:
        runner.ports.close()
    for name in [n for n in sys.modules if n.split("_generated")[0] in COMPONENTS]:
        del sys.modules[name]


def test_gaze_example_follows_the_face_until_its_event_expires(
    create_runner: Callable[..., Runner],
) -> None:
    (json,) = [block.text for block in blocks(PAGE) if block.language == "json"]
    detector, explorer = create_runner("face_detector"), create_runner("explorer")
    head = create_runner(
        "head_control",
        monitors=parse_monitors(json),
        connections={"GazeTarget": ("face_detector", "explorer")},
    )
    head.start()
    connections = [detector.worker.gazetarget_proxy, explorer.worker.gazetarget_proxy]
    wait_until(lambda: all(proxy.has_subscribers() for proxy in connections))
    judged = 0

    def gaze_after(sender: Runner) -> tuple[float, float]:
        """The gaze when a message of `sender` has been passed or rejected."""
        nonlocal judged
        judged += 1
        sender.worker.compute()
        wait_until(lambda: sum(s.passed + s.rejected for s in head.monitors.statuses()) == judged)
        with head.callback_group:  # the handler has returned
            return head.worker.gaze

    face = (0.3, 0.1)
    detector.worker.clock.time = 4.0  # no face: the detector is not sure
    assert gaze_after(detector) == (0.0, 0.0)
    around = gaze_after(explorer)
    assert around not in {(0.0, 0.0), face}
    detector.worker.clock.time = 8.0  # a face
    assert gaze_after(detector) == face
    head.worker.clock.time = 0.999
    assert gaze_after(explorer) == face
    detector.worker.clock.time = 12.0  # the face is away, but its event is not
    assert gaze_after(detector) == face
    assert [s.is_winner for s in head.monitors.statuses()] == [True, False]
    head.worker.clock.time = 1.0
    assert gaze_after(explorer) not in {around, face}
    assert [(s.passed, s.rejected) for s in head.monitors.statuses()] == [(1, 2), (2, 1)]
    head.stop()
    assert head.wait()


def test_gaze_example_plan_passes_the_monitors_that_the_page_shows(folder: Path) -> None:
    (json,) = [block.text for block in blocks(PAGE) if block.language == "json"]
    report = Report()
    deployment = check_ddsl(folder / "gaze.ddsl", Workspace([folder], environ={}), report)
    assert deployment is not None
    assert not list(report)
    planned = plan_deployment(deployment, name="gaze", domain="d", interpreter="/py")
    arguments = {process.name: process.argv for process in planned.processes}
    head = arguments.pop("head_control")
    value = head[head.index("--monitors") + 1].replace(f"{folder}/", "")
    assert parse_monitors(value) == parse_monitors(json)
    assert all("--monitors" not in argv for argv in arguments.values())


def test_gaze_example_runs_as_the_page_shows(tmp_path: Path, environment: dict[str, str]) -> None:
    with Session(tmp_path, environment) as session:
        for block in blocks(PAGE):
            session.execute(block)


def test_gaze_example_monitor_fits_its_interface(folder: Path) -> None:
    operations = (MonitoredOperation("look", (("target", ""),)),)
    text = (folder / "monitors.py").read_text()
    result = check_monitor_class(text, "CertainFace", operations, {"certainty": 0.8})
    assert (result.findings, result.events) == ([], {"e_face"})
