"""The touch demo as a real process: simulator, arm and reflex deployed and touched."""

import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from robocomp_dsl.runtime.client import DomainClient
from robocomp_dsl.runtime.errors import MiddlewareError
from tests.demo.component_modules import COMPONENTS
from tests.demo.touch_demo_samples import demo
from tests.support.waiting import wait_until

DEADLINE = 150.0
COMPONENT_NAMES = ("robot", "arm", "reflex")

pytestmark = pytest.mark.xdist_group("demo")  # they want a processor for themselves


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """The folder `components`, where it may be written to."""
    leave = shutil.ignore_patterns("__pycache__")
    return Path(shutil.copytree(COMPONENTS, tmp_path / "components", ignore=leave))


def command(components: Path, *options: str) -> list[str]:
    program = components / "touch_demo" / "demo.py"
    picture = components.parent / "demo.png"
    return [sys.executable, str(program), "--touches", "1", "--picture", str(picture), *options]


def run(components: Path, *options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command(components, *options),
        capture_output=True,
        text=True,
        timeout=2 * DEADLINE,
        check=False,
    )


def log(components: Path, name: str) -> str:
    return (components.parent / "build" / "touch_demo" / f"{name}.log").read_text()


@pytest.mark.parametrize(("key", "name"), [("nao", "NAO"), ("icub", "iCub")])
def test_touch_demo_reports_and_draws_withdrawals(copy: Path, key: str, name: str) -> None:
    ran = run(copy, "--robot", key)
    assert ran.returncode == 0, ran.stdout + ran.stderr + log(copy, key)
    output = ran.stdout.splitlines()
    assert output[0] == f"{name}: starting simulator, arm and reflex ..."
    assert output[1] == f"{name}: touching the lower arm outer"
    row = next(line for line in output if re.match(rf"{name} +lower arm outer +\d", line))
    force, withdrawn, moved, cleared = (float(touch) for touch in re.findall(r"[\d.]+", row))
    assert row.count("lower arm outer") == 2  # the place, and the field that answered
    assert 0.2 < force < 20
    assert withdrawn > 10
    assert 0 <= moved < 2000
    assert 0 < cleared < 2000
    picture = imread(copy.parent / "demo.png")
    assert picture.shape[1] == 1600

    saved = demo().recording.load(copy.parent / "build" / "touch_demo" / f"{key}.npz")
    assert (np.diff(saved.frame_time) > 0).all()
    assert np.median(np.diff(saved.frame_time)) == pytest.approx(0.02, abs=2e-3)
    assert saved.presses[0].place == "lower_arm_outer"
    assert saved.force.max() > 0
    assert {answer.field for answer in saved.answers} >= {"lower_arm_outer"}


def test_touch_demo_fails_if_arm_does_not_withdraw(copy: Path) -> None:
    ddsl = copy / "touch_demo" / "nao.ddsl"
    ddsl.write_text(ddsl.read_text().replace("set full", "set enabled = false;\n        set full"))
    ran = run(copy, "--robot", "nao")
    assert ran.returncode == 1, ran.stdout + ran.stderr
    assert re.search(r"^demo: NAO, lower arm outer: (no field|the arm)", ran.stderr, re.MULTILINE)
    assert "Traceback" not in ran.stderr
    assert imread(copy.parent / "demo.png").shape[1] == 1600


def test_touch_demo_fails_at_once_if_component_exits(copy: Path) -> None:
    process = subprocess.Popen(
        command(copy, "--robot", "nao", "--touches", "5"),  # it is not over when it is killed
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        pids = running(f"touch-nao-{process.pid}")
        assert process.stdout
        while "touching" not in process.stdout.readline():
            assert process.poll() is None
        os.kill(pids["reflex"], signal.SIGKILL)
        _, complaint = process.communicate(timeout=DEADLINE)
    finally:
        process.kill()
    assert process.returncode == 1
    assert "`reflex` ended in the middle of the demo" in complaint
    assert "Traceback" not in complaint
    assert not [pid for pid in pids.values() if is_alive(pid)]


def running(domain: str) -> dict[str, int]:
    """The process ids of the components, once all of them run."""
    links = DomainClient(domain)
    try:
        return wait_until(
            lambda: {name: links.component(name).getInfo().pid for name in COMPONENT_NAMES},
            "the components have not started",
            DEADLINE,
            ignoring=MiddlewareError,
        )
    finally:
        links.close()


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_touch_demo_reports_failed_deployment_start(copy: Path) -> None:
    ddsl = copy / "touch_demo" / "nao.ddsl"
    ddsl.write_text(ddsl.read_text().replace("robot.LArm", "robot.LeftArm"))
    ran = run(copy, "--robot", "nao")
    assert ran.returncode == 1
    assert ran.stderr.startswith("demo: rcdeploy ended early, with exit code")
    assert "`robot` has no port `LeftArm`" in ran.stderr
    assert "Traceback" not in ran.stderr
