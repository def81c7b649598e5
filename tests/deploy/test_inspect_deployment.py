"""The inspecting commands of `rcdeploy` in a running deployment."""

from __future__ import annotations

import json
from pathlib import Path

from tests.deploy.laser_app import start_app
from tests.deploy.rcdeploy_process import rcdeploy


def test_inspect_commands_find_components_of_deployment(app_folder: Path) -> None:
    with start_app() as app:
        app.until("all 2 components are ready")
        listed = rcdeploy("app.ddsl", "list").stdout
        assert "arm.Laser" in listed
        assert "requires" in listed
        details = rcdeploy("list", "arm.Laser").stdout
        assert "float angle [rad]" in details
        result = rcdeploy("call", "arm.Laser.getLaserData", "--json", "-d", "app")
        assert json.loads(result.stdout)[0]["angle"] == 0.5
        rows = json.loads(rcdeploy("app.ddsl", "connections", "eye", "--json").stdout)
        laser = next(row for row in rows if row["port"] == "Laser")
        assert (laser["peer"], laser["state"]) == ("arm.Laser", "Connected")
        changed = rcdeploy("qos", "app.ddsl", "eye.Laser", "arm.Laser", "priority=high")
        assert changed.stdout.startswith("eye.Laser with arm.Laser: priority=high"), changed.stderr
        removed = rcdeploy("app.ddsl", "disconnect", "eye.Laser", "arm.Laser")
        assert "disconnected until eye ends" in removed.stdout, removed.stderr
        again = rcdeploy("app.ddsl", "connect", "eye.Laser", "arm.Laser")
        assert "connect eye.Laser -> arm.Laser;" in again.stdout, again.stderr
        assert rcdeploy("connections", "app").stdout.count("Laser") >= 2
        changed = rcdeploy("qos", "app", "eye.Laser", "arm.Laser", "priority=off")
        assert changed.stdout.startswith("eye.Laser with arm.Laser: the defaults"), changed.stderr
        stored = rcdeploy("qos", "app", "eye.Laser", "arm.Laser", "priority=low", "--ddsl")
        assert stored.stdout.splitlines()[-1].startswith("written to "), stored.stderr
        statement = "connect eye.Laser -> arm.Laser { priority low; };"
        assert statement in (app_folder / "app.ddsl").read_text()
        wrong = rcdeploy("call", "amr.Laser.getLaserData")
        assert (wrong.returncode, "did you mean `arm`?" in wrong.stderr) == (1, True), wrong.stderr
