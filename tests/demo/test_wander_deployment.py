"""The deployment of the demo as it is shipped, in a copy: three processes over zenoh."""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime.component.component_interface import LifeState
from robocomp_dsl.runtime.errors import MiddlewareError
from tests.demo.component_modules import COMPONENTS, load
from tests.support.waiting import wait_until

DEADLINE = 90.0
RCDEPLOY = Path(sys.executable).with_name("rcdeploy")

pytestmark = pytest.mark.xdist_group("demo")  # they want a processor for themselves


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """The folder `components`, where it may be written to."""
    leave = shutil.ignore_patterns("__pycache__")
    return Path(shutil.copytree(COMPONENTS, tmp_path / "components", ignore=leave))


def wait_for(condition: Callable[[], bool], message: str) -> None:
    """Wait for the condition; components may be absent meanwhile."""
    wait_until(condition, message, DEADLINE, ignoring=MiddlewareError)


@contextmanager
def deployed(ddsl: Path, name: str) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [str(RCDEPLOY), str(ddsl), "up", "--name", name, "--domain", name, "--no-table"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=DEADLINE)
        finally:
            process.kill()


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_wander_deployment_drives_summarises_and_draws(copy: Path, tmp_path: Path) -> None:
    picture = tmp_path / "demo.png"
    ran = subprocess.run(
        [sys.executable, copy / "wander" / "demo.py", "--seconds", "4", "--picture", picture],
        capture_output=True,
        text=True,
        timeout=2 * DEADLINE,
        check=False,
    )
    # 1 with this line: another load on the machine held the simulation up, all else is as it was
    slow = "did not keep up" in ran.stderr
    assert ran.returncode == (1 if slow else 0), ran.stdout + ran.stderr
    for output in ("all 3 components are ready", "times real time", "getLaserData", "nearest"):
        assert output in ran.stdout
    assert picture.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert picture.stat().st_size > 20_000
    path = np.genfromtxt(tmp_path / "build" / "wander" / "path.csv", delimiter=",", names=True)
    assert path["time_s"][-1] >= 4
    assert (np.diff(path["time_s"]) > 0).all()
    assert path["run"].max() == 0
    way = np.hypot(np.diff(path["x_mm"]), np.diff(path["z_mm"])).sum()
    assert way > 300
    assert path["adv_mm_s"].max() == pytest.approx(450, abs=30)  # as wander's configuration says


def test_wander_deployment_restarts_killed_robot(copy: Path) -> None:
    name = f"kill-{os.getpid()}"
    with deployed(copy / "wander" / "wander.ddsl", name) as process:
        observer = load("wander/observer.py").Observer(name)
        try:
            pids = kill_and_wait_for_restart(observer)
        finally:
            observer.close()
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0, output
    assert "mobile_base" in output
    assert not [pid for pid in pids if is_alive(pid)]


def kill_and_wait_for_restart(observer: object) -> list[int]:
    """Kills mobile_base in mid-run; returns all process ids there were."""
    path = observer.path()  # type: ignore[attr-defined]
    proxies = {
        name: observer.component(name)  # type: ignore[attr-defined]
        for name in ("mobile_base", "wander", "path_logger")
    }
    wait_for(lambda: path().distance > 300, "the first 300 mm")
    before = {name: proxy.getInfo().pid for name, proxy in proxies.items()}
    driven = path().distance
    os.kill(before["mobile_base"], signal.SIGKILL)

    wait_for(lambda: path().runs == 2, "a second run of the robot")
    wait_for(lambda: path().distance > driven + 300, "another 300 mm")
    after = {name: proxy.getInfo() for name, proxy in proxies.items()}
    assert after["mobile_base"].pid != before["mobile_base"]
    assert after["wander"].pid == before["wander"]
    assert after["path_logger"].pid == before["path_logger"]
    assert after["wander"].state == LifeState.Compute
    return [*before.values(), after["mobile_base"].pid]
