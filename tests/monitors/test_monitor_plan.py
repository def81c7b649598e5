"""The plan passes monitors and conditions of services to both ends."""

from __future__ import annotations

import shutil
from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.plan import plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors
from tests.docs.blocks import ROOT

DEPLOYMENT = """
import "sem_parts/body.cdsl";
import "sem_parts/reflex.cdsl";

Deployment demo
{
    component body;
    component planner : reflex { prefix left; };
    component user : reflex;
    connect planner.Laser -> body.Laser { monitor "urgent.py" Urgent at receiver; };
    arbitrate body.Laser
    {
        from planner.Laser when e_urgent;
        from user.Laser when !e_urgent;
    };
};
"""
MONITOR = """
from robocomp_dsl.runtime import Monitor

class Urgent(Monitor):
    def accept(self, operation, arguments):
        self.set_event("e_urgent", 1.0)
        return True
"""


def test_monitor_plan_of_a_service_has_an_entry_at_both_ends(tmp_path: Path) -> None:
    shutil.copytree(ROOT / "tests" / "cases" / "ddsl" / "sem_parts", tmp_path / "sem_parts")
    (tmp_path / "urgent.py").write_text(MONITOR)
    (tmp_path / "demo.ddsl").write_text(DEPLOYMENT)
    report = Report()
    deployment = check_ddsl(tmp_path / "demo.ddsl", Workspace(environ={}), report)
    assert deployment is not None
    assert [finding.message for finding in report] == []
    planned = plan(deployment, name="demo", domain="d", interpreter="/py")
    ends = {
        process.name: [
            (c.peer, c.position, c.constraint.text if c.constraint else "")
            for c in parse_monitors(process.argv[process.argv.index("--monitors") + 1])
        ]
        for process in planned.processes
    }
    assert ends == {
        "body": [
            ("left/planner.Laser", "receiver", "e_urgent"),
            ("user.Laser", "receiver", "!e_urgent"),
        ],
        "left/planner": [("/body.Laser", "identify", "")],
        "user": [("body.Laser", "identify", "")],
    }
