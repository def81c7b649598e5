"""`rcdeploy up` with a group in one process."""

from __future__ import annotations

import os
import signal
from pathlib import Path

from tests.deploy.laser_app import last_number, start_app, status
from tests.deploy.rcdeploy_process import rcdeploy

APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
group side
{
    component arm { set serial = "abc"; };
    component eye { after arm; };
    export Laser from arm;
};
Deployment app
{
    group left : side { inprocess; set arm.rate = 30; ready within 200 s; };
    component eye { after left; ready within 200 s; };
    connect eye.Laser -> left.Laser;
};
"""


def test_up_runs_group_in_one_process_and_restarts_it(app_folder: Path) -> None:
    (app_folder / "app.ddsl").write_text(APP)
    with start_app() as app:
        app.until("left-arm | arm begins with abc 30.0", "all 2 components are ready")
        while sum("eye sees a new arm" in line for line in app.lines) < 2:
            app.until("eye sees a new arm")
        group, eye = status()["components"]
        assert [group["name"], eye["name"]] == ["left", "eye"]
        assert group["members"] == [["left-arm", "compute"], ["left-eye", "compute"]]
        refused = rcdeploy("stop", "app", "left-arm")
        assert refused.returncode == 1
        assert "`left-arm` runs in the process of the group `left`" in refused.stdout
        logged = rcdeploy("logs", "app", "--component", "left-arm")
        assert "asked by a client" in logged.stdout
        os.kill(group["pid"], signal.SIGKILL)
        app.until("left: killed by SIGKILL, restarting", "left is ready")
        while sum("eye sees a new arm" in line for line in app.lines) < 4:
            app.until("eye sees a new arm")
        restarted = status()["components"]
        assert restarted[1]["pid"] == eye["pid"]
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
    seen = [last_number(line) for line in app.lines if "eye sees a new arm" in line]
    assert seen == [group["pid"]] * 2 + [restarted[0]["pid"]] * 2
    ends = [line.split("| ")[1] for line in app.lines if "finalizes" in line]
    assert ends == ["eye finalizes", "eye finalizes", "arm finalizes"]


LOCKSTEP = """
import "{components}/mobile_base/mobile_base.cdsl";
import "{components}/wander/wander.cdsl";
Deployment app
{{
    clock sim lockstep limit 60 s;
    group all {{ inprocess; ready within 200 s; component base : mobile_base;
        component wander {{ after base; }}; }};
}};
"""


def test_up_runs_group_in_one_process_in_lockstep(app_folder: Path) -> None:
    components = Path(__file__).parents[2] / "components"
    (app_folder / "app.ddsl").write_text(LOCKSTEP.format(components=components))
    with start_app() as app:
        app.until("in lock-step with all-wander", "all is ready")
        clock = status()["clock"]
        assert clock["seconds"] >= 0.0
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
