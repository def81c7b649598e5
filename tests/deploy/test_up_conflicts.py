"""`rcdeploy` beside a running deployment, with ports in use and with failing components."""

from __future__ import annotations

import socket
from pathlib import Path

from tests.deploy.laser_app import APP, last_number, start_app, status
from tests.deploy.rcdeploy_process import rcdeploy


def test_check_accepts_port_of_running_deployment(app_folder: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    (app_folder / "app.ddsl").write_text(APP.replace("env MODE", f"port {port}; env MODE"))
    with start_app() as app:
        app.until("all 2 components are ready")
        assert rcdeploy("app.ddsl", "check").returncode == 0
        assert f"--listen-port {port}" in rcdeploy("app.ddsl", "plan").stdout
        again = rcdeploy("app.ddsl")
        assert again.returncode == 1
        assert "`app` is already running (pid" in again.stderr
        other = rcdeploy("app.ddsl", "--name", "other")
        assert other.returncode == 1
        assert f"port {port} cannot be used" in other.stderr
        app.process.terminate()
        assert app.end() == 0


def test_deployments_of_same_file_are_isolated(app_folder: Path) -> None:
    with start_app() as first:
        first.until("all 2 components are ready")
        with start_app() as refused:
            assert refused.end() == 1
            assert refused.has(f"`app` is already running (pid {first.process.pid},")
        with start_app("--name", "other") as other:
            server = last_number(other.until("eye sees a new arm"))
            assert server == next(
                row["pid"] for row in status("other")["components"] if row["name"] == "arm"
            )
            unclear = rcdeploy("stop", "app.ddsl")
            assert unclear.returncode == 1
            assert "several deployments are running" in unclear.stderr
            assert rcdeploy("stop", "other").returncode == 0
            assert other.end() == 0
        assert [row["state"] for row in status("app")["components"]] == ["ready", "ready"]
        first.process.terminate()
        assert first.end() == 0
    assert not first.has("AmbiguousServer")


FAILING = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        raise RuntimeError("no such device")
"""


def test_up_ends_when_component_fails_to_initialize(app_folder: Path) -> None:
    text = (app_folder / "arm" / "specificworker.py").read_text()
    head = text.partition("class SpecificWorker")[0]
    (app_folder / "arm" / "specificworker.py").write_text(head + FAILING)
    (app_folder / "app.ddsl").write_text(
        APP.replace("env MODE", "restart on-failure max 1; env MODE")
    )
    with start_app() as app:
        assert app.end() == 1
    assert app.has("initialize failed")
    assert app.has("arm failed permanently: exit code 1 (restart limit reached: 1 in 60 s")
    assert app.lines[-1] == "error: failed: arm"
    assert not app.has("eye is ready")


def test_up_starts_nothing_when_port_is_in_use(app_folder: Path, socket_folder: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        (app_folder / "app.ddsl").write_text(APP.replace("env MODE", f"port {port}; env MODE"))
        with start_app() as app:
            assert app.end() == 1
    assert app.has(f"port {port} cannot be used: Address already in use")
    assert [path.name for path in socket_folder.iterdir()] == [
        ".deployments"
    ]  # no domain was opened
