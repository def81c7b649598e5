"""The deployment of the demo in lock-step, as fast as it can: the same path twice, byte by byte."""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError
from tests.demo.component_modules import COMPONENTS, load
from tests.support.waiting import wait_until

DEADLINE = 120.0
RCDEPLOY = Path(sys.executable).with_name("rcdeploy")
SECONDS = 6.0
"""Of simulated time: the robot comes to a wall and turns away."""

pytestmark = pytest.mark.xdist_group("demo")  # they want a processor for themselves


def wait_for(condition: Callable[[], bool], process: subprocess.Popen[str], message: str) -> None:
    """Wait for the condition while rcdeploy runs; components may be absent meanwhile."""

    def holds() -> bool:
        if process.poll() is not None:
            pytest.fail(f"rcdeploy ended early:\n{process.communicate()[0]}")
        return condition()

    wait_until(holds, message, DEADLINE, ignoring=MiddlewareError)


def copied(folder: Path, hold_at: float) -> Path:
    """The deployment in lock-step, as fast as it can, in a folder that may be written to."""
    leave = shutil.ignore_patterns("__pycache__")
    components = Path(shutil.copytree(COMPONENTS, folder / "components", ignore=leave))
    ddsl = components / "wander" / "wander.ddsl"
    text = ddsl.read_text()
    text = text.replace("Deployment wander\n{", "Deployment wander\n{\n    clock sim lockstep;")
    text = text.replace(
        "mobile_base {", f"mobile_base {{ set speed = 0; set hold_at = {hold_at:g};"
    )
    ddsl.write_text(text)
    return ddsl


def deployed(ddsl: Path, name: str) -> subprocess.Popen[str]:
    command = [str(RCDEPLOY), str(ddsl), "up", "--name", name, "--domain", name, "--no-table"]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def status(name: str) -> str:
    command = [str(RCDEPLOY), "status", name]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def drive(folder: Path, name: str) -> tuple[bytes, str]:
    """What the path logger wrote, and what rcdeploy said of the time meanwhile."""
    process = deployed(copied(folder, SECONDS), name)
    try:
        wait_for(lambda: ", paused" in status(name), process, f"{SECONDS:g} s of simulated time")
        shown = status(name)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0, output
    finally:
        process.kill()
    return (folder / "build" / "wander" / "path.csv").read_bytes(), shown


def test_lockstep_deployment_drives_identically_twice(tmp_path: Path) -> None:
    (first, shown), (again, _) = (
        drive(tmp_path / str(number), f"step{number}-{os.getpid()}") for number in (1, 2)
    )
    assert f"simulated time {SECONDS:.2f} s, paused" in shown
    assert first == again
    lines = [line.split(b",") for line in first.splitlines()[1:]]
    assert float(lines[-1][1]) > SECONDS - 0.05
    assert max(abs(float(line[-1])) for line in lines) > 0.3, "it has not turned"


def test_deployment_continues_and_restarts_killed_component(tmp_path: Path) -> None:
    name = f"killed-{os.getpid()}"
    process = deployed(copied(tmp_path, 0.0), name)
    try:
        observer = load("wander/observer.py").Observer(name)
        try:
            path, wander = observer.path(), observer.component("wander")
            wait_for(lambda: path().time > 1.0, process, "the first second")
            before = wander.getInfo().pid
            os.kill(before, signal.SIGKILL)
            killed = path().time
            wait_for(lambda: path().time > killed + 1.0, process, "a second without it")
            wait_for(lambda: wander.getStatistics().cycles > 5, process, "its return")
            assert wander.getInfo().pid != before
        finally:
            observer.close()
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0, output
        assert "wander timed out or disconnected at" in output
        assert "wander rejoined at" in output
    finally:
        process.kill()
