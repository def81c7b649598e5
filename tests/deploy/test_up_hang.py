"""`rcdeploy` with a generated component whose `compute` hangs once: watchdog, restart, status."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.deploy.generated_components import generate_components
from tests.deploy.laser_app import start_app
from tests.deploy.rcdeploy_process import rcdeploy

ARM = """
class SpecificWorker(GenericWorker):
    def compute(self):
        first = not os.path.exists("hung")
        open("hung", "w").close()
        while first:
            time.sleep(0.01)
    def finalize(self):
        print("arm finalizes")
"""
APP = """
import "arm/arm.cdsl";
Deployment app
{
    component arm { set serial = "abc"; watchdog 500 ms; ready within 200 s; };
};
"""


@pytest.fixture
def hanging_app(tmp_path: Path, socket_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    generate_components(tmp_path, {"arm": ARM})
    (tmp_path / "app.ddsl").write_text(APP)


def test_hanging_compute_is_restarted_and_shown_in_status(hanging_app: None) -> None:
    with start_app() as running:
        running.until("arm is ready after")
        running.until("watchdog: compute has hung for")
        running.until("arm finalizes")
        running.until("arm is ready after")
        rows = json.loads(rcdeploy("status", "app", "--format", "json").stdout)["components"]
        text = rcdeploy("status", "app").stdout
        rcdeploy("stop")
        assert running.end() == 0
    (arm,) = rows
    assert (arm["state"], arm["restarts"]) == ("ready", 1)
    assert arm["hang"]["activity"] == "compute"
    assert any("in compute" in line for line in arm["hang"]["stack"])
    assert arm["hang"]["location"].startswith(str(Path.cwd() / "arm" / "specificworker.py"))
    assert arm["overruns"] >= 0
    assert "arm, " in text
    assert " ago: compute has hung for" in text
    assert "time.sleep(0.01)" in text
