"""Plans that a device manager refuses."""

from __future__ import annotations

import pytest

from robocomp_dsl.hardware.device_manager.check import PlanError
from tests.hardware.device_manager.device_journal import ARM, DeviceJournal, device

WRONG = [
    ({"devices": [device("a", "driver"), device("a", "driver")]}, "there are two devices `a`"),
    ({"devices": [device("a", "drive")]}, "no kind `drive`; did you mean `driver`?"),
    ({"devices": ARM, "attach": {"zero": "arn"}}, "no device `arn`; did you mean `arm`?"),
    (
        {"devices": ARM, "attach": {"arm": "zero"}},
        "`arm` is attached to 1 devices; it supports none",
    ),
    ({"devices": ARM, "attach": {"zero": ["arm", "arm"]}}, "attached to a device twice"),
    ({"devices": ARM, "attach": {"all": "zero", "zero": "all"}}, "`all` is attached to itself"),
    ({"devices": ARM, "attach": {"all": "all"}}, "`all` is attached to itself"),
    ({"devices": ARM, "actions": [{"phase": "run", "park": "arm"}]}, "`run` has no actions"),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "level": -1, "abort": "arm"}]},
        "a level is 0 or more",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "park": "leg"}]},
        "there is no device `leg`",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "calibrate": "arm"}]},
        "on startup level 0 calibrate arm: no calibrator is attached to `arm`",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "calibrate": "arm", "by": "all"}]},
        "`all` is no calibrator",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "calibrate": "arm", "by": "zero"}]},
        "`zero` is not attached to `arm`",
    ),
    (
        {
            "devices": [*ARM, device("other", "calibrator")],
            "attach": {"zero": "arm", "other": "arm"},
            "actions": [{"phase": "startup", "calibrate": "arm"}],
        },
        "`zero`, `other` could do that; name one with `by`",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "attach": "all"}]},
        "`all` has no entry in `attach`",
    ),
    (
        {
            "devices": ARM,
            "attach": {"all": "arm"},
            "actions": [{"phase": "startup", "attach": "all", "by": "zero"}],
        },
        "only `calibrate` and `park` are done `by` another device",
    ),
]


@pytest.mark.parametrize(("data", "message"), WRONG)
def test_device_manager_refuses_invalid_plan_before_opening_devices(data, message):
    journal = DeviceJournal()
    with pytest.raises(PlanError) as refused:
        journal.manager(**data)
    assert message in str(refused.value)
    assert journal.entries == []


def test_device_manager_runs_several_actions_of_one_level():
    journal = DeviceJournal()
    actions = [{"phase": "shutdown", "level": 4, verb: "zero"} for verb in ("detach", "abort")]
    assert journal.manager(devices=ARM, attach={"zero": "arm"}, actions=actions).start()
