"""Devices all the way: from a deployment in DDSL to what happens to them in the process."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check import check_ddsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.deploy import devices as told
from robocomp_dsl.deploy.plan import plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.plumbing import host
from robocomp_dsl.hardware.plumbing.description import (
    Action,
    Attachment,
    DeviceSpec,
    Phase,
    Plumbing,
    Verb,
)
from robocomp_dsl.hardware.plumbing.host import described
from robocomp_dsl.hardware.plumbing.read import BadDescription

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


def test_a_deployment_tells_its_processes_of_their_devices(tmp_path: Path) -> None:
    (tmp_path / "body.cdsl").write_text(CDSL)
    path = tmp_path / "demo.ddsl"
    path.write_text(DDSL)
    report = Report()
    deployment = check_ddsl(path, Workspace(environ={}), report)
    assert [one.message for one in report] == []
    assert deployment is not None
    made = plan(deployment, name="demo", domain="d", interpreter="python3")
    body, plain = made.processes
    environment = dict(body.env)
    assert environment["EXTRA"] == "1"
    assert described(environment) == Plumbing(
        (
            DeviceSpec("arm", "control_board", {"part": "LArm", "sim": True}),
            DeviceSpec("zeroing", "calibrator", {"home.LElbowRoll": -0.6, "timeout": 20}),
        ),
        (Attachment("zeroing", ("arm",)),),
        (
            Action(Phase.STARTUP, 5, Verb.CALIBRATE, "arm"),
            Action(Phase.SHUTDOWN, 1, Verb.PARK, "arm", "zeroing"),
        ),
    )
    assert plain.env == ()
    assert described(dict(plain.env)) == Plumbing(())


def test_both_sides_mean_the_same_variable() -> None:
    assert told.VARIABLE == host.VARIABLE


@pytest.mark.parametrize(("text", "said"), [("{", "is no JSON"), ("[]", "is a mapping")])
def test_what_is_no_description_is_refused(text: str, said: str) -> None:
    with pytest.raises(BadDescription, match=said):
        described({host.VARIABLE: text})
