"""`rcdeploy` beside hung components, and two deployments that share a domain."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from robocomp_dsl.deploy import control, instances
from tests.deploy.generated_components import generate_components
from tests.deploy.laser_app import start_app
from tests.deploy.rcdeploy_process import RunningProcess, rcdeploy
from tests.middleware.domain_process import domain_process
from tests.support.waiting import wait_until

BOUND_S = 15.0
"""Generous for a busy machine, and far below the 10 s that each hung process took."""
ARM = """
class SpecificWorker(GenericWorker):
    def finalize(self):
        print("arm finalizes")
"""
EYE = """
class SpecificWorker(GenericWorker):
    def compute(self):
        self.set_period(0)
"""
APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    component arm { set serial = "abc"; ready within 200 s; };
    component eye { ready within 200 s; };
};
"""


@pytest.fixture
def folder(tmp_path: Path, socket_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two generated components that do not call each other, and their deployment."""
    monkeypatch.chdir(tmp_path)
    generate_components(tmp_path, {"arm": ARM, "eye": EYE})
    (tmp_path / "app.ddsl").write_text(APP)
    return tmp_path


def rcdeploy_in_time(*arguments: str) -> subprocess.CompletedProcess[str]:
    started = time.monotonic()
    run = rcdeploy(*arguments)
    assert time.monotonic() - started < BOUND_S, arguments
    return run


def is_stopped(pid: int) -> bool:
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] in "Tt"


def stop_process(pid: int) -> None:
    os.kill(pid, signal.SIGSTOP)
    wait_until(lambda: is_stopped(pid))


def test_rcdeploy_commands_beside_stopped_processes(folder: Path) -> None:
    with (
        start_app("--domain", "lab") as app,
        domain_process("lab") as first,
        domain_process("lab") as second,
    ):
        app.until("all 2 components are ready")
        rows = next(control.send_request("app", {"verb": "status"}))["rows"]
        arm = next(row["pid"] for row in rows if row["name"] == "arm")
        for pid in (first.pid, second.pid, arm):
            stop_process(pid)
        status = rcdeploy_in_time("status", "app")
        assert "does not answer within" in status.stdout
        assert "compute" in status.stdout.split("eye", 1)[1]
        # The component that hangs is reported, the other one is shown.
        listed = rcdeploy_in_time("param", "list", "app")
        assert (listed.returncode, "eye has no parameters" in listed.stdout) == (1, True)
        assert listed.stderr.startswith("error: `arm` does not answer within")
        assert rcdeploy_in_time("param", "get", "app", "arm", "rate").returncode == 1
        assert rcdeploy_in_time("logs", "app").returncode == 0
        assert is_stopped(arm), "it hangs to the end"
        # A stopped component is continued, so that it can finalize.
        assert rcdeploy_in_time("stop", "app").returncode == 0
        app.end()
    assert app.has("arm finalizes")


def test_rcdeploy_commands_of_a_stopped_rcdeploy_end(folder: Path) -> None:
    with start_app() as app:
        app.until("all 2 components are ready")
        stop_process(app.process.pid)
        for command in (["status"], ["logs", "-f"], ["stop"], ["param", "list", "app"]):
            run = rcdeploy_in_time(*command)
            assert run.returncode == 1, command
            assert run.stderr.startswith("error: `app` does not "), command
        with pytest.raises(instances.Unavailable, match="its rcdeploy may be stopped"):
            next(control.send_request("app", {"verb": "stop"}))
        assert is_stopped(app.process.pid)
        app.process.send_signal(signal.SIGCONT)
        app.process.terminate()
        app.end()


def test_two_deployments_that_share_a_domain_and_a_name(folder: Path) -> None:
    """The second is refused before anything starts; the first does not notice."""
    with start_app("--domain", "lab") as first:
        first.until("all 2 components are ready")
        rows = next(control.send_request("app", {"verb": "status"}))["rows"]
        refused = rcdeploy_in_time("up", "app.ddsl", "--domain", "lab", "--name", "other")
        assert refused.returncode == 1
        for row in rows:
            running = f"`{row['name']}`: a component of this name runs in the domain `lab`"
            assert f"RC908]: {running} (pid {row['pid']}, started 20" in refused.stderr
        assert "app.ddsl:6:15" in refused.stderr
        assert "nothing was started (2 errors)" in refused.stderr
        # The same by hand.
        command = [sys.executable, "main.py", "--domain", "lab", "--set", "serial=x"]
        with RunningProcess(*command, where=folder / "arm") as guest:
            assert guest.end() == 1
        assert guest.has("`arm` is already running in the domain `lab` (pid ")
        # In another domain all is well.
        with start_app("--domain", "hall", "--name", "other", "--duration", "0") as second:
            assert second.end() == 0
        assert next(control.send_request("app", {"verb": "status"}))["rows"][0]["restarts"] == 0
        first.process.terminate()
        assert first.end() == 0


def test_two_deployments_of_a_name_that_start_at_once(folder: Path) -> None:
    with (
        start_app("--domain", "lab", "--name", "one") as first,
        start_app("--domain", "lab", "--name", "two") as second,
    ):
        wait_until(
            lambda: first.process.poll() is not None or second.process.poll() is not None,
            timeout=120,
        )
        refused, running = (first, second) if first.process.poll() is not None else (second, first)
        assert refused.end() == 1
        running.until("all 2 components are ready")
        assert refused.has("in the domain `lab`")
        assert not refused.has("is ready")
        running.process.terminate()
        assert running.end() == 0
