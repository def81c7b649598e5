"""Two touches at once, and touches that no field is for: on the shipped robots and components.

Rows 8 and 9 of the acceptance table, with the forces that physics makes. What is expected is worked
out by `equations`, for each touch alone; what one mean of both touches would say must not happen.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import fingertip
import numpy as np
import pytest
from equations import gain
from puppet import words
from whole import BOARDS, Whole

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.law import Field

OUTER, UNDER, FRONT = "lower_arm_outer", "lower_arm_under", "upper_arm_front"
OTHER = fingertip.FINGERS[1]
FULL = 0.2


@pytest.fixture(scope="module", params=list(BOARDS), ids=[f"{r}-{s}" for r, s in BOARDS])
def robot(request: pytest.FixtureRequest) -> Iterator[Whole]:
    made = Whole(*request.param, hold=0.2)
    try:
        made.until("Watching", 5.0)
        yield made
    finally:
        made.close()


@pytest.fixture
def whole(robot: Whole) -> Iterator[Whole]:
    """At rest in its start pose, with the fields that it ships with."""
    fields = robot.reflex.getFields()
    robot.reflex.setForces(0.0, FULL)
    yield robot
    robot.take_away()
    robot.reflex.setFields(fields)
    robot.reflex.enable(True)
    robot.params(withdraw_speed=0.45)
    robot.run(0.1)
    robot.until("Watching")
    robot.run(1.0)  # the refractory time


def only(whole: Whole, field: Field) -> None:
    limb = f"{whole.side}/{field.limb}"
    told = words.Field(field.name, limb, *field.centre.tolist(), field.radius, field.motion)
    whole.reflex.setFields([told])


def moved(whole: Whole, name: str, x: float, radius: float) -> Field:
    """A field as wide as this at another place along the limb of `name`, on its cone."""
    field = whole.field(name)
    cone = whole.part.limb(field.limb).cone
    out = field.centre[1:] / np.linalg.norm(field.centre[1:])
    centre = np.array([x, *(float(cone.radius(x)) * out)])
    return Field("f", field.limb, centre, radius, field.motion)


def answer(whole: Whole) -> Any:
    """To what presses meanwhile for so long that it has come to rest; None: nothing answers."""
    known = len(whole.events())
    whole.run(0.3)
    assert len(whole.events()) == known, "it was disabled"
    whole.reflex.enable(True)
    whole.run(0.04)
    told = whole.events()[known:]
    return told[0] if told else None


def touched(whole: Whole, event: Any) -> tuple[Floats, Floats]:
    """Points (k, 3) and forces (k,) of the taxels of the limb that felt something."""
    geometry = whole.world.simulation.skin.geometry
    force = whole.world.frames[event.time].astype(np.float32).astype(float)
    index = np.flatnonzero((force > 0) & (geometry.limb == geometry.limbs.index(event.limb)))
    return geometry.points[index], force[index]


def test_fingers_on_both_sides_are_two_touches(whole: Whole) -> None:
    """Row 8: one mean of both lies inside the limb, where no field would answer."""
    whole.reflex.enable(False)
    count, field = whole.reflex.getStatistics().withdrawals, whole.field(OUTER)
    only(whole, field)
    whole.press(field, 0.002)
    whole.press(whole.field("lower_arm_inner"), 0.002, finger=OTHER)
    told = answer(whole)
    points, forces = touched(whole, told)
    mine = points @ np.array([0.0, *field.centre[1:]]) > 0.0
    assert forces[mine].sum() > 0.3
    assert forces[~mine].sum() > 0.3
    alone = gain(points[mine], forces[mine], field.centre, field.radius, 0.0, FULL)
    assert told.gain == pytest.approx(alone, abs=1e-5)
    assert told.motion == pytest.approx(alone * field.motion, abs=1e-5)
    together = forces @ points / forces.sum()
    assert np.linalg.norm(together - field.centre) > 0.6 * field.radius
    assert told.distance < 0.3 * field.radius
    assert whole.reflex.getStatistics().withdrawals == count + 1


def test_a_touch_elsewhere_on_the_limb_takes_nothing_away(whole: Whole) -> None:
    """Row 9: the second finger presses the same limb beyond the field, at the same time."""
    whole.reflex.enable(False)
    count, cone = whole.reflex.getStatistics().withdrawals, whole.part.limb("lower_arm").cone
    field = moved(whole, OUTER, cone.x0 + 0.01, 0.02)
    only(whole, field)
    whole.press(field, 0.003)
    whole.press(moved(whole, OUTER, cone.x1 - 0.01, 0.02), 0.003, finger=OTHER)
    told = answer(whole)
    points, forces = touched(whole, told)
    mine = points[:, 0] < (cone.x0 + cone.x1) / 2
    assert forces[mine].sum() > 0.3
    assert forces[~mine].sum() > 0.3
    alone = gain(points[mine], forces[mine], field.centre, field.radius, 0.0, FULL)
    assert told.gain == pytest.approx(alone, abs=1e-5)
    together = forces @ points / forces.sum()
    assert np.linalg.norm(together - field.centre) > field.radius  # no field would answer
    assert told.distance < 0.5 * field.radius
    assert whole.reflex.getStatistics().withdrawals == count + 1


def test_a_finger_off_all_fields_is_felt_and_left_alone(whole: Whole) -> None:
    """With the fields that ship: nobody watches the back of the upper arm."""
    count, start = whole.reflex.getStatistics().withdrawals, whole.arm.getState().position
    front = whole.field(FRONT)
    back = Field("back", front.limb, front.centre * (1.0, -1.0, -1.0), 0.01, front.motion)
    whole.press(back, 0.003)
    felt = []
    for _ in range(25):
        whole.run(0.02)
        felt.append(whole.felt())
        assert whole.state == "Watching"
    assert max(felt) > 0.3
    assert felt[-1] > 0.1  # it still presses
    assert whole.reflex.getStatistics().withdrawals == count
    assert whole.arm.getState().position == pytest.approx(start, abs=0.05)


def test_two_fingers_at_once_withdraw_by_both_fields(whole: Whole) -> None:
    whole.reflex.enable(False)
    count = whole.reflex.getStatistics().withdrawals
    fields = [whole.field(name) for name in (UNDER, FRONT)]
    for field, finger in zip(fields, fingertip.FINGERS, strict=True):
        whole.press(field, 0.003, finger=finger)
    assert answer(whole) is not None
    held, limits = whole.worker(1).withdrawal, whole.arm.getLimits()
    assert set(held.strongest) >= {UNDER, FRONT}
    motion = sum(one.motion for one in held.strongest.values())
    assert held.goal == pytest.approx(np.clip(held.origin + motion, limits.low, limits.high))
    whole.run(0.5)
    assert whole.reflex.getStatistics().withdrawals == count + 1


def test_a_finger_that_comes_during_a_withdrawal_adds_to_it(whole: Whole) -> None:
    whole.reflex.setForces(0.005, 0.02)
    whole.params(withdraw_speed=0.05)
    whole.press(whole.field(OUTER), 0.003)
    whole.until("Withdrawing", 1.0)
    held, count = whole.worker(1).withdrawal, whole.reflex.getStatistics().withdrawals
    assert FRONT not in held.strongest
    whole.press(whole.field(FRONT), 0.004, finger=OTHER)
    whole.run(0.3)
    more = whole.worker(1).withdrawal
    assert FRONT in more.strongest
    assert np.abs(more.goal - held.goal).max() > 0.05
    assert whole.reflex.getStatistics().withdrawals == count
