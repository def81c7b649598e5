"""Physics, skin, control board, generic arm and the reflex component: a finger presses, the arm
withdraws. The same component, without a word about a robot, on both bodies.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from pressed import Pressed
from puppet import Touched
from stepped import TICK

from robocomp_dsl.tactile.reflex.law import Field

ARMS = [(n, s) for n in ("nao_h21", "nao_h25", "icub_v2") for s in ("left_arm", "right_arm")]
PLACES = ("lower_arm_outer", "lower_arm_inner", "lower_arm_under", "lower_arm_upper",
          "upper_arm_front")  # fmt: skip
FORCES = {"threshold": 0.03, "full": 0.12}


@pytest.fixture
def stage() -> Iterator[Callable[..., Touched]]:
    made: list[Touched] = []

    def make(robot: str, side: str, **said: object) -> Touched:
        made.append(Touched(robot, side, Pressed, **{**FORCES, **said}))
        return made[-1].awake()

    yield make
    for one in made:
        one.close()


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(("robot", "side"), ARMS)
def test_a_pressed_arm_withdraws_and_comes_back(stage, robot, side, place) -> None:
    touched = stage(robot, side)
    it, field = touched.robot, touched.field(place)
    before = it.spot(field)
    it.press(field, 0.004, 0.5)
    while not it.felt().any() and it.path:
        touched.run(TICK)
    felt = touched.world.clock.now()
    touched.run(0.5)
    assert it.moves, "it was felt and left alone"
    assert it.moves[0][0] - felt <= 0.0401
    assert place in touched.worker().withdrawal.strongest
    assert np.linalg.norm(it.spot(field) - before) > 0.01
    assert not it.felt().any()  # the finger is still there, the arm is not
    touched.run(4.0)
    assert touched.state == "Watching"
    assert it.poses[-1] == pytest.approx(it.part.start, abs=0.05)
    seen = touched.reflex.getStatistics()
    assert seen.withdrawals == 1
    assert seen.framesAccepted > 100
    assert touched.worker().sense.gate.rejected.total() < 20  # while the geometry was unknown


def test_a_touch_outside_all_fields_is_felt_and_left_alone(stage) -> None:
    touched = stage("icub_v2", "left_arm")
    keep = [f for f in touched.reflex.getFields() if f.name == "lower_arm_inner"]
    touched.reflex.setFields(keep)
    lonely = Field("x", "lower_arm", np.array([0.03, 0.026, 0.026]), 0.03, np.zeros(5))
    touched.robot.press(lonely, 0.002, 0.3)
    touched.run(0.5)
    assert touched.robot.peak > 1.0
    assert touched.robot.moves == []


def test_a_gentle_touch_below_the_threshold_is_left_alone(stage) -> None:
    touched = stage("nao_h21", "left_arm", threshold=50.0, full=60.0)
    touched.robot.press(touched.field("lower_arm_under"), 0.002, 0.3)
    touched.run(0.5)
    assert touched.robot.peak > 0.5
    assert touched.robot.moves == []
