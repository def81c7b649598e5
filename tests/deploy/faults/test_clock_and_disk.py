"""The clock of one process is set one hour off, and the disk with the logs is full."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.campaign.running_deployment import RunningDeployment
from tests.support.shifted_clock import (
    COMPILER,
    clock_environment,
    compile_clock,
    set_clock_offset,
)
from tests.support.waiting import wait_until

CLOCK = """
import "echo/echo.cdsl";
import "bystander/bystander.cdsl";
Deployment clock
{{
    component echo
    {{
        watchdog 1 s; {environment}
    }};
    component bystander {{ after echo; }};
}};
"""


def calls(folder: Path) -> int:
    path = folder / "journals/bystander"
    return len(path.read_text().splitlines()) if path.exists() else 0


def fill_up(path: Path) -> None:
    """Write until an error ends it."""
    with path.open("wb", buffering=0) as stream:
        while True:
            stream.write(bytes(4096))


@pytest.mark.skipif(not shutil.which(COMPILER), reason="no C compiler is installed")
def test_clock_set_one_hour_off_ends_nothing(folder: Path) -> None:
    compile_clock(folder)
    variables = clock_environment(folder)
    path = folder / "clock.ddsl"
    environment = " ".join(f'env {name} = "{value}";' for name, value in variables.items())
    path.write_text(CLOCK.format(environment=environment))
    with RunningDeployment(path) as app:
        app.wait_ready()
        for offset in (3600.0, -3600.0):
            set_clock_offset(folder, offset)
            before = calls(folder)
            # Longer than the watchdog.
            wait_until(lambda: calls(folder) > before + 120, "calls go on after the step")  # noqa: B023
        rows = app.rows()
        assert {row["state"] for row in rows.values()} == {"ready"}
        assert [row["restarts"] for row in rows.values()] == [0, 0]
        assert app.stop() == 0
    text = app.log.read_text()
    assert "WARNING" not in text.replace("compute exceeded", "")
    assert "bystander: " not in text


@pytest.mark.skipif(
    os.getuid() != 0 or not shutil.which("unshare"), reason="needs root for a private mount"
)
def test_full_disk_under_logs_ends_nothing(folder: Path, tmp_path: Path) -> None:
    """The state folder is a file system of 400 kB, which only rcdeploy and its children see."""
    state = tmp_path / "state"
    state.mkdir()
    script = 'mount -t tmpfs -o size=400k tmpfs "$XDG_STATE_HOME" && exec "$@"'
    command = [sys.executable, "-m", "robocomp_dsl.cli.rcdeploy", str(folder / "campaign.ddsl")]
    log = tmp_path / "log"
    with log.open("wb") as stream:
        process = subprocess.Popen(
            ["unshare", "--mount", "sh", "-c", script, "sh", *command],
            env={**os.environ, "XDG_STATE_HOME": str(state)},
            cwd=folder,
            stdout=stream,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    try:
        wait_until(lambda: "components are ready" in log.read_text(), "all are ready", 60)
        inside = Path(f"/proc/{process.pid}/root{state}")
        with pytest.raises(OSError, match="No space left"):
            fill_up(inside / "fill")
        before = calls(folder)
        wait_until(lambda: calls(folder) > before + 100, "calls go on")
        assert process.poll() is None
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0, log.read_text()[-2000:]
    assert list(state.iterdir()) == []
