"""Fields and forces that the reflex refuses."""

from __future__ import annotations

import numpy as np
import pytest

from tests.touch.kinematic_robot import interfaces

FIELD = {"name": "f", "limb": "left_arm/lower_arm", "x": 0.05, "y": 0.0, "z": 0.03,
         "radius": 0.03, "motion": np.full(5, 0.1)}  # fmt: skip

WRONG_FIELDS = {
    "no limb `left_arm/tail`": {"limb": "left_arm/tail"},
    "write the limb as `left_arm/LIMB`": {"limb": "lower_arm"},
    "is on `right_arm/lower_arm`": {"limb": "right_arm/lower_arm"},
    "NaN or infinity": {"x": np.nan},
    "holds NaN": {"motion": np.full(5, np.inf)},
    "must be positive": {"radius": 0.0},
    "has 3 angles, the arm 5": {"motion": np.zeros(3)},
}


@pytest.mark.parametrize(("message", "wrong"), WRONG_FIELDS.items(), ids=list(WRONG_FIELDS))
def test_reflex_rejects_invalid_fields_unchanged(start_reflex, message, wrong) -> None:
    harness = start_reflex("icub_v2").wait_until_watching()
    before = [field.name for field in harness.reflex.getFields()]
    with pytest.raises(interfaces.RoboCompReflex_NotPossible) as caught:
        harness.reflex.setFields(
            [interfaces.Field(**FIELD), interfaces.Field(**{**FIELD, "name": "g", **wrong})]
        )
    assert message in caught.value.what
    assert [field.name for field in harness.reflex.getFields()] == before


def test_reflex_refuses_duplicate_field_names(harness) -> None:
    with pytest.raises(interfaces.RoboCompReflex_NotPossible, match="two fields of the name `f`"):
        harness.reflex.setFields([interfaces.Field(**FIELD), interfaces.Field(**FIELD)])


@pytest.mark.parametrize(
    ("threshold", "full"), [(1.0, 1.0), (2.0, 1.0), (-1.0, 1.0), (np.nan, 1.0), (0.1, np.inf)]
)
def test_reflex_refuses_invalid_forces_unchanged(harness, threshold, full) -> None:
    law = harness.worker().sense.law
    with pytest.raises(interfaces.RoboCompReflex_NotPossible):
        harness.reflex.setForces(threshold, full)
    assert harness.worker().sense.law is law
