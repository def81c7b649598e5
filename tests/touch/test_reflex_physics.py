"""Physics, skin, control board, generic arm and the reflex component: a finger presses, the arm
withdraws. The same component, without a word about a robot, on both bodies.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.tactile.reflex.law import Field
from tests.touch.equations import gain
from tests.touch.kinematic_robot import ReflexHarness, interfaces
from tests.touch.lockstep_harness import TICK
from tests.touch.physical_robot import PhysicalRobot

ARMS = [(n, s) for n in ("nao_h21", "nao_h25", "icub_v2") for s in ("left_arm", "right_arm")]
PLACES = ("lower_arm_outer", "lower_arm_inner", "lower_arm_under", "lower_arm_upper",
          "upper_arm_front")  # fmt: skip
FORCES = {"threshold": 0.03, "full": 0.12}


@pytest.fixture
def start_physical_reflex() -> Iterator[Callable[..., ReflexHarness]]:
    """Makes robots, and looks at all their joints did when the test is over."""
    systems: list[ReflexHarness] = []

    def make(robot: str, side: str, **params: object) -> ReflexHarness:
        systems.append(ReflexHarness(robot, side, PhysicalRobot, **{**FORCES, **params}))
        return systems[-1].wait_until_watching()

    yield make
    for system in systems:
        system.close()
    for system in systems:
        assert_within_limits(system.robot)


def assert_within_limits(robot: PhysicalRobot) -> None:
    """The angles and speeds that the joints really had, whatever was commanded."""
    poses, speeds = np.array(robot.poses), np.abs(robot.speeds)
    assert (poses >= robot.arm.low).all()
    assert (poses <= robot.arm.high).all()
    assert (speeds <= robot.arm.speed_limits + 1e-9).all(), (speeds / robot.arm.speed_limits).max(0)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(("robot", "side"), ARMS)
def test_reflex_withdraws_pressed_arm_and_returns(
    start_physical_reflex, robot, side, place
) -> None:
    harness = start_physical_reflex(robot, side)
    it, field = harness.robot, harness.field(place)
    before = it.spot(field)
    it.press(field, 0.004, 0.5)
    while not it.taxel_forces().any() and it.path:
        harness.run(TICK)
    felt = harness.world.clock.now()
    harness.run(0.5)
    assert it.moves, "it was felt and left alone"
    assert it.moves[0][0] - felt <= 0.0401
    assert place in harness.worker().withdrawal.strongest
    assert np.linalg.norm(it.spot(field) - before) > 0.01
    assert not it.taxel_forces().any()  # the finger is still there, the arm is not
    harness.run(4.0)
    assert harness.state == "Watching"
    assert it.poses[-1] == pytest.approx(it.part.start, abs=0.05)
    seen = harness.reflex.getStatistics()
    assert seen.withdrawals == 1
    assert seen.framesAccepted > 100
    assert harness.worker().sense.validator.rejected.total() < 20  # while the geometry was unknown


def test_reflex_ignores_gentle_touch_below_threshold(start_physical_reflex) -> None:
    harness = start_physical_reflex("nao_h21", "left_arm", threshold=50.0, full=60.0)
    harness.robot.press(harness.field("lower_arm_under"), 0.002, 0.3)
    harness.run(0.5)
    assert harness.robot.peak > 0.5
    assert harness.robot.moves == []


def events(harness: ReflexHarness) -> list[Any]:
    return [event for event in harness.robot.reflex_messages if isinstance(event, interfaces.Event)]


def strength(harness: ReflexHarness, name: str) -> float:
    """How strongly a field has answered so far."""
    return max((event.gain for event in events(harness) if event.field == name), default=0.0)


def set_fields(harness: ReflexHarness, *names: str) -> None:
    harness.reflex.setFields([field for field in harness.reflex.getFields() if field.name in names])


BOTH = pytest.mark.parametrize("robot", ["nao_h25", "icub_v2"])


@BOTH
def test_reflex_responses_to_physics_match_equations(start_physical_reflex, robot) -> None:
    """Rows 2, 3 and 7 of the acceptance table, with the forces that physics makes of a press."""
    harness = start_physical_reflex(robot, "left_arm", full=5.0, law="fixed")
    it, place = harness.robot, "lower_arm_outer"
    set_fields(harness, place)
    it.press(harness.field(place), 0.003, 0.3, along=0.006)
    harness.run(0.4)
    responses = events(harness)
    assert responses
    field, geometry = harness.field(place), it.geometry
    for event in responses:
        force = it.frames[event.time].astype(float)
        index = np.flatnonzero((force > 0) & (geometry.limb == geometry.limbs.index(event.limb)))
        assert len(index) > 3
        points = geometry.points[index]
        expected = gain(points, force[index], field.centre, field.radius, 0.03, 5.0)
        assert event.gain == pytest.approx(expected, abs=1e-5)
        assert event.motion == pytest.approx(expected * field.motion, abs=1e-5)


SYMMETRIC = [
    ("nao_h25", "lower_arm_under"),
    ("nao_h25", "upper_arm_front"),
    ("icub_v2", "lower_arm_under"),
    ("icub_v2", "upper_arm_front_distal"),
]
"""Fields whose taxels lie evenly around the centre, so that a press on it is felt there."""


@pytest.mark.parametrize(("robot", "place"), SYMMETRIC)
def test_reflex_saturates_at_hard_press_on_centre(start_physical_reflex, robot, place) -> None:
    """Rows 1 and 6: as far as the base motion says, and no further."""
    harness = start_physical_reflex(robot, "right_arm", threshold=0.01, full=0.05, law="fixed")
    set_fields(harness, place)
    start, field = harness.robot.poses[-1], harness.field(place)
    harness.robot.press(field, 0.004, 0.3)
    harness.run(0.3)
    (last,) = [event for event in events(harness) if event.gain == strength(harness, place)]
    assert last.force > 0.05
    assert last.gain > 0.9
    assert last.gain == pytest.approx(1 - last.distance / field.radius)
    harness.run_until("Holding")
    assert harness.robot.poses[-1] - start == pytest.approx(last.motion, abs=0.05)


def answer_to(harness: ReflexHarness, field: Field, depth: float, along: float = 0.0) -> Any:
    """What the field `f` answers to a press that the arm has borne for a while; None: nothing."""
    harness.reflex.enable(False)
    harness.robot.press(field, depth, 0.5, along=along)
    harness.run(0.3)
    assert harness.robot.taxel_forces().sum() > 0.2
    harness.reflex.enable(True)
    harness.run(TICK)
    responses = events(harness)
    return responses[0] if responses else None


def one_field(harness: ReflexHarness, radius: float) -> Field:
    """The only field is that of the place, as wide as this."""
    field = harness.field("lower_arm_outer")
    centre = field.centre.tolist()
    harness.reflex.setFields(
        [interfaces.Field("f", "left_arm/lower_arm", *centre, radius, field.motion)]
    )
    return field


@BOTH
def test_reflex_withdraws_further_with_harder_press(start_physical_reflex, robot) -> None:
    """Rows 2, 5 and 6."""
    responses = []
    for depth in (0.0004, 0.0008, 0.0016, 0.0032):
        harness = start_physical_reflex(robot, "left_arm", threshold=0.0, full=2.0)
        responses.append(answer_to(harness, one_field(harness, 0.03), depth))
    forces, gains = [event.force for event in responses], [event.gain for event in responses]
    assert forces == sorted(forces)
    assert gains == sorted(gains)
    assert len(set(gains)) == 4
    harness = start_physical_reflex(robot, "left_arm", threshold=forces[-1] + 0.1, full=50.0)
    assert answer_to(harness, one_field(harness, 0.03), 0.0032) is None
    assert harness.robot.moves == []


@BOTH
def test_reflex_responds_weaker_off_centre_and_not_outside(start_physical_reflex, robot) -> None:
    """Rows 3 and 4: along the limb from the centre to beyond the edge."""
    responses = []
    for along in (0.0, 0.012, 0.02, 0.03):
        harness = start_physical_reflex(robot, "left_arm", threshold=0.0, full=0.001)
        responses.append(answer_to(harness, one_field(harness, 0.025), 0.002, along))
    assert responses.pop() is None
    assert harness.robot.moves == []
    away, gains = (
        [response.distance for response in responses],
        [response.gain for response in responses],
    )
    assert away == sorted(away)
    assert gains == pytest.approx([1 - response / 0.025 for response in away])
    assert away[-1] - away[0] > 0.005


@BOTH
def test_reflex_ignores_dead_patch_in_physics(start_physical_reflex, robot) -> None:
    harness = start_physical_reflex(robot, "left_arm")
    it = harness.robot
    dead = it.geometry.patch == it.geometry.patches.index("left_lower_arm")
    alive = it.taxel_forces
    it.taxel_forces = lambda: np.where(dead, 0.0, alive())
    it.press(harness.field("lower_arm_under"), 0.002, 0.3)
    harness.run(0.5)
    assert it.peak > 0.3
    assert it.moves == []
    it.press(harness.field("upper_arm_front"), 0.002, 0.3)
    harness.run(0.3)
    assert it.moves


@BOTH
def test_reflex_stops_arm_when_skin_falls_silent(start_physical_reflex, robot) -> None:
    harness = start_physical_reflex(robot, "left_arm", withdraw_speed=0.1)
    it = harness.robot
    it.press(harness.field("lower_arm_outer"), 0.003, 0.3)
    harness.run_until("Withdrawing", 1.0)
    harness.robot.publishes_skin = False
    harness.run_until("Frozen", 1.0)
    harness.run(0.3)
    here = it.poses[-1]
    harness.run(0.5)
    assert it.stops == 1
    assert it.poses[-1] == pytest.approx(here, abs=0.01)
    assert np.abs(it.speeds[-1]).max() < 0.05
    harness.robot.publishes_skin = True
    harness.run_until("Watching")
    assert it.poses[-1] == pytest.approx(it.part.start, abs=0.05)
