"""Simulator, generic_arm and reflex as they are shipped: the finger presses, the arm withdraws.

The same folder `reflex` on both robots and both arms; what differs are two parameters and a wire.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from equations import gain
from whole import BOARDS, Whole

from robocomp_dsl.runtime.lifecycle import State

PLACES = ("lower_arm_outer", "lower_arm_inner", "lower_arm_under", "lower_arm_upper",
          "upper_arm_front")  # fmt: skip


@pytest.fixture(scope="module", params=list(BOARDS), ids=[f"{r}-{s}" for r, s in BOARDS])
def whole(request: pytest.FixtureRequest) -> Iterator[Whole]:
    made = Whole(*request.param, threshold=0.005, full=0.02, hold=1.0)
    try:
        made.until("Watching", 5.0)
        made.run(0.5)
        yield made
    finally:
        made.close()


def test_the_arm_withdraws_from_the_finger_and_comes_back(whole: Whole) -> None:
    for place in PLACES:
        field, start = whole.field(place), whole.arm.getState().position
        before, count = whole.spot(field), whole.reflex.getStatistics().withdrawals
        whole.press(field, 0.004)
        felt = acted = cleared = 0.0
        for _ in range(40):
            whole.run(0.02)
            now = whole.world.clock.now()
            felt = felt or (now if whole.felt() > 0 else 0.0)
            acted = acted or (now if whole.state == "Withdrawing" else 0.0)
            cleared = now if whole.felt() > 0 else cleared
        assert felt, place
        assert 0.0 < acted - felt + 0.02 <= 0.0801, place  # frames come every 20 ms
        assert place in whole.worker(1).withdrawal.strongest
        assert np.linalg.norm(whole.spot(field) - before) > 0.01, place
        assert cleared - felt < 0.6, place
        assert whole.felt() == 0.0, place  # the finger is still there, the arm is not
        assert whole.reflex.getStatistics().withdrawals == count + 1
        whole.take_away()
        whole.until("Watching")
        whole.run(0.5)
        assert whole.arm.getState().position == pytest.approx(start, abs=0.03), place
    keeps_to_its_limits(whole)


def test_a_touch_below_the_threshold_and_one_outside_all_fields_are_left_alone(
    whole: Whole,
) -> None:
    fields = whole.reflex.getFields()
    count = whole.reflex.getStatistics().withdrawals
    start = whole.arm.getState().position
    whole.reflex.setForces(20.0, 30.0)
    whole.press(whole.field("lower_arm_under"), 0.002)
    peak = 0.0
    for _ in range(20):
        whole.run(0.02)
        peak = max(peak, whole.felt())
    assert peak > 0.1
    whole.take_away()
    whole.reflex.setForces(0.005, 0.02)
    whole.reflex.setFields([one for one in fields if one.name == "upper_arm_front"])
    whole.press(whole.field("lower_arm_under"), 0.002)
    whole.run(0.4)
    whole.take_away()
    whole.run(0.1)
    whole.reflex.setFields(fields)
    seen = whole.reflex.getStatistics()
    assert seen.withdrawals == count
    assert whole.arm.getState().position == pytest.approx(start, abs=0.05)
    bad = (seen.framesNotFinite, seen.framesWrongLength, seen.framesOutOfOrder)
    assert bad == (0, 0, 0)
    assert seen.framesOtherGeometry == 0


def test_every_answer_is_what_the_equations_say_of_the_frame(whole: Whole) -> None:
    """The forces that physics makes, through the simulated skin; a little off the centre."""
    whole.until("Watching")
    whole.run(1.0)
    known, geometry = len(whole.events()), whole.world.simulation.skin.geometry
    whole.reflex.setForces(0.0, 0.5)
    whole.press(whole.field("lower_arm_outer"), 0.003, along=0.006)
    whole.run(0.4)
    told = whole.events()[known:]
    assert told
    for event in told:
        force = whole.world.frames[event.time].astype(np.float32).astype(float)
        index = np.flatnonzero((force > 0) & (geometry.limb == geometry.limbs.index(event.limb)))
        field = whole.field(event.field)
        assert len(index) > 1
        points, forces = geometry.points[index], force[index]
        expected = gain(points, forces, field.centre, field.radius, 0.0, 0.5)
        assert event.gain == pytest.approx(expected, abs=1e-5)
        assert event.motion == pytest.approx(expected * field.motion, abs=1e-5)
    whole.take_away()
    whole.reflex.setForces(0.005, 0.02)
    whole.until("Watching")


def test_a_skin_that_dies_on_the_way_stops_the_arm_and_all_recovers(whole: Whole) -> None:
    """Frames come twice a second, for a reflex that is blind after 0.2 s."""
    whole.reflex.setForces(0.005, 0.02)
    whole.press(whole.field("lower_arm_outer"), 0.004)
    whole.until("Withdrawing", 1.0)
    whole.world.params.set({"skin.rate": 2.0})
    whole.until("Frozen", 2.0)
    assert whole.runners[1].state is State.EMERGENCY
    whole.take_away()
    whole.run(0.5)
    here = whole.arm.getState().position
    whole.run(0.5)
    assert whole.arm.getState().position == pytest.approx(here, abs=0.01)
    whole.world.params.set({"skin.rate": 50.0})
    whole.until("Watching")
    assert whole.runners[1].state is State.COMPUTE
    keeps_to_its_limits(whole)


def keeps_to_its_limits(whole: Whole) -> None:
    """What the joints in the physics really did, from the first moment on."""
    angles, speeds = whole.joints()
    assert angles.min() >= 0.0
    assert angles.max() <= 1.0
    assert speeds.max() <= 1.0, speeds.max(axis=0)
