"""The deployment of the demo in lock-step, as fast as it can: the same path twice, byte by byte."""

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from parts import COMPONENTS, load

from robocomp_dsl.runtime.errors import MiddlewareError

DEADLINE = 120.0
RCDEPLOY = Path(sys.executable).with_name("rcdeploy")
SECONDS = 6.0
"""Of simulated time: the robot comes to a wall and turns away."""

pytestmark = pytest.mark.xdist_group("demo")  # they want a processor for themselves


def until(condition: Callable[[], bool], process: subprocess.Popen[str], what: str) -> None:
    deadline = time.monotonic() + DEADLINE
    while time.monotonic() < deadline:
        if process.poll() is not None:
            pytest.fail(f"rcdeploy ended early:\n{process.communicate()[0]}")
        try:
            if condition():
                return
        except MiddlewareError:
            pass  # not there yet
        time.sleep(0.02)
    pytest.fail(f"{what} did not come to pass within {DEADLINE:.0f} s")


def drive(folder: Path, name: str) -> tuple[bytes, str]:
    """What the path logger wrote, and what rcdeploy said of the time meanwhile."""
    leave = shutil.ignore_patterns("__pycache__")
    components = Path(shutil.copytree(COMPONENTS, folder / "components", ignore=leave))
    ddsl = components / "wander" / "wander.ddsl"
    text = ddsl.read_text()
    text = text.replace("Deployment wander\n{", "Deployment wander\n{\n    clock sim lockstep;")
    text = text.replace("mobile_base {", "mobile_base { set speed = 0;")
    ddsl.write_text(text)
    command = [str(RCDEPLOY), str(ddsl), "up", "--name", name, "--domain", name, "--no-table"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        observer = load("wander/observer.py").Observer(name)
        try:
            path = observer.path()
            until(lambda: path().time > SECONDS, process, f"{SECONDS:g} s")
            status = [str(RCDEPLOY), "status", name]
            shown = subprocess.run(status, capture_output=True, text=True, check=True).stdout
        finally:
            observer.close()
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0, said
    finally:
        process.kill()
    return (folder / "build" / "wander" / "path.csv").read_bytes(), shown


def test_two_drives_are_the_same(tmp_path: Path) -> None:
    (first, shown), (again, _) = (
        drive(tmp_path / str(number), f"step{number}-{os.getpid()}") for number in (1, 2)
    )
    assert "times real time" in shown
    # Ctrl-C ends them at different moments.
    until_then = min(len(one) for one in (first, again))
    lines = first[:until_then].splitlines()[:-1]
    assert again[:until_then].splitlines()[:-1] == lines
    times = [float(line.split(b",")[1]) for line in lines[1:]]
    assert times[-1] >= SECONDS - 0.1
    turned = {float(line.split(b",")[-1]) for line in lines[1:]}
    assert max(abs(rot) for rot in turned) > 0.3, "it has not turned, the laser was not used"
