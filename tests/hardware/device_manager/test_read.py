"""Descriptions of devices from plain data: what is read, and what is told of bad ones."""

from __future__ import annotations

import pytest
import yaml

from robocomp_dsl.hardware.device_manager.description import (
    Attachment,
    DeviceAction,
    DevicePlan,
    DeviceSpec,
    Phase,
    Verb,
)
from robocomp_dsl.hardware.device_manager.read import InvalidPlan, read_plan

TEXT = """
devices:
  - {name: arm, kind: control_board, part: LArm}
  - {name: zeroing, kind: calibrator, speed: 0.5, home.LElbowRoll: -0.6}
attach: {zeroing: [arm]}
actions:
  - {phase: startup, level: 5, calibrate: arm}
  - {phase: shutdown, level: 1, park: arm, by: zeroing}
backwards: true
"""


def test_device_plan_is_read():
    assert read_plan(yaml.safe_load(TEXT)) == DevicePlan(
        (
            DeviceSpec("arm", "control_board", {"part": "LArm"}),
            DeviceSpec("zeroing", "calibrator", {"speed": 0.5, "home.LElbowRoll": -0.6}),
        ),
        (Attachment("zeroing", ("arm",)),),
        (
            DeviceAction(Phase.STARTUP, 5, Verb.CALIBRATE, "arm"),
            DeviceAction(Phase.SHUTDOWN, 1, Verb.PARK, "arm", "zeroing"),
        ),
        backwards=True,
    )
    assert read_plan({}) == DevicePlan(())


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (None, "a plan is a mapping"),
        ([1], "a plan is a mapping"),
        ({"device": []}, "`device`: not known; there are devices, attach, actions, backwards"),
        ({"devices": {}, "actions": 3}, "`actions`: a list is needed"),
        ({"devices": ["arm"]}, "`devices[0]`: a mapping is needed"),
        ({"devices": [{"name": "arm"}]}, "`devices[0]`: a device has a `name` and a `kind`"),
        ({"devices": [{"name": "a", "kind": "k", "p": [1]}]}, "`devices[0].p`: a number"),
        ({"attach": [1]}, "`attach`: a mapping"),
        ({"attach": {"a": []}}, "`attach.a`: a list of devices"),
        ({"attach": {"a": [1]}}, "`attach.a`: a list of devices"),
        ({"actions": [{"park": "a"}]}, "`actions[0].phase`: one of startup, run, interrupt1"),
        ({"actions": [{"phase": "startup"}]}, "`actions[0]`: one of attach, detach, calibrate"),
        ({"actions": [{"phase": "startup", "park": "a", "abort": "a"}]}, "`actions[0]`: one of"),
        ({"actions": [{"phase": "startup", "park": 1}]}, "`actions[0]`: one of"),
        ({"actions": [{"phase": "startup", "park": "a", "level": 1.5}]}, "whole number"),
        ({"actions": [{"phase": "startup", "park": "a", "level": True}]}, "whole number"),
        ({"actions": [{"phase": "startup", "park": "a", "by": 1}]}, "`actions[0].by`"),
        ({"actions": [{"phase": "startup", "park": "a", "lvl": 1}]}, "`actions[0].lvl`: not known"),
        ({"backwards": "yes"}, "`backwards`: true or false"),
    ],
)
def test_device_plan_of_another_form_is_refused(data, message):
    with pytest.raises(InvalidPlan) as refused:
        read_plan(data)
    assert message in str(refused.value)
