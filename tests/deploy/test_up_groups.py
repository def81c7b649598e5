"""`rcdeploy` with groups: all of them, or a single group."""

from __future__ import annotations

import signal
from pathlib import Path

from tests.deploy.laser_app import GROUPED_APP, last_number, start_app, status
from tests.deploy.rcdeploy_process import rcdeploy


def test_up_runs_groups(app_folder: Path) -> None:
    (app_folder / "app.ddsl").write_text(GROUPED_APP)
    with start_app() as app:
        app.until("all 3 components are ready")
        while sum("eye sees a new arm" in line for line in app.lines) < 2:
            app.until("eye sees a new arm")
        rows = status()["components"]
        assert [c["name"] for c in rows] == ["left-arm", "left-eye", "eye"]
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
    seen = [last_number(line) for line in app.lines if "eye sees a new arm" in line]
    assert seen == [rows[0]["pid"]] * 2


def test_up_runs_single_group(app_folder: Path) -> None:
    (app_folder / "app.ddsl").write_text(GROUPED_APP)
    with start_app("--group", "left") as app:
        app.until("all 2 components are ready", "eye sees a new arm")
        rows = status("app-left")["components"]
        assert [c["name"] for c in rows] == ["left-arm", "left-eye"]
        stopped = rcdeploy("stop", "app-left")
        assert stopped.returncode == 0
        assert app.end() == 0
    unknown = rcdeploy("plan", "app.ddsl", "--group", "right")
    assert unknown.returncode == 2
    assert "`app` has no group `right`; its groups: left" in unknown.stderr
