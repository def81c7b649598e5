"""Devices all the way: from a deployment in DDSL to what happens to them in the process."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy import devices as told
from robocomp_dsl.deploy.plan import plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.device_manager import host
from robocomp_dsl.hardware.device_manager.description import (
    Attachment,
    DeviceAction,
    DevicePlan,
    DeviceSpec,
    Phase,
    Verb,
)
from robocomp_dsl.hardware.device_manager.host import plan_from_environment
from robocomp_dsl.hardware.device_manager.read import InvalidPlan

CDSL = "Component body { Communications { }; language Python; period 10; };"
DDSL = """
import "body.cdsl";
Deployment demo {
    component body {
        env EXTRA = 1;
        device arm : control_board { set part = LArm; set sim = true; };
        device zeroing : calibrator { set home.LElbowRoll = -0.6; set timeout = 20; };
        attach zeroing to arm;
        ON Startup level 5 Calibrate arm;
        on shutdown level 1 park arm by zeroing;
    };
    component plain : body;
};
"""


def test_deployment_plan_passes_device_descriptions_to_processes(tmp_path: Path) -> None:
    (tmp_path / "body.cdsl").write_text(CDSL)
    path = tmp_path / "demo.ddsl"
    path.write_text(DDSL)
    report = Report()
    deployment = check_ddsl(path, Workspace(environ={}), report)
    assert [finding.message for finding in report] == []
    assert deployment is not None
    result = plan(deployment, name="demo", domain="d", interpreter="python3")
    body, plain = result.processes
    environment = dict(body.env)
    assert environment["EXTRA"] == "1"
    assert plan_from_environment(environment) == DevicePlan(
        (
            DeviceSpec("arm", "control_board", {"part": "LArm", "sim": True}),
            DeviceSpec("zeroing", "calibrator", {"home.LElbowRoll": -0.6, "timeout": 20}),
        ),
        (Attachment("zeroing", ("arm",)),),
        (
            DeviceAction(Phase.STARTUP, 5, Verb.CALIBRATE, "arm"),
            DeviceAction(Phase.SHUTDOWN, 1, Verb.PARK, "arm", "zeroing"),
        ),
    )
    assert plain.env == ()
    assert plan_from_environment(dict(plain.env)) == DevicePlan(())


def test_device_host_and_deployment_use_same_variable() -> None:
    assert told.DEVICES_VARIABLE == host.DEVICES_VARIABLE


@pytest.mark.parametrize(("text", "message"), [("{", "is not valid JSON"), ("[]", "is a mapping")])
def test_host_description_of_another_form_is_refused(text: str, message: str) -> None:
    with pytest.raises(InvalidPlan, match=message):
        plan_from_environment({host.DEVICES_VARIABLE: text})
