"""Touches of every kind at the component's ports: how far the arm goes, and when."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime.parameters import ParameterRejected
from tests.touch.kinematic_robot import ROBOTS, CentredRobot, ReflexHarness, interfaces

ARMS = [(robot, side) for robot in ROBOTS for side in ("left_arm", "right_arm")]
QUICK = {"refractory": 0.0, "hold": 0.02, "return_speed": 1.0}


@pytest.fixture
def start_reflex() -> Iterator[Callable[..., ReflexHarness]]:
    systems: list[ReflexHarness] = []

    def make(*arguments: object, **params: object) -> ReflexHarness:
        systems.append(ReflexHarness(*arguments, **params))
        return systems[-1].awake()

    yield make
    for system in systems:
        system.close()


@pytest.fixture(params=ARMS, ids=[f"{robot}-{side}" for robot, side in ARMS])
def touched(start_reflex, request) -> ReflexHarness:
    return start_reflex(*request.param, CentredRobot)


def withdrawal(touched: ReflexHarness, taxels: np.ndarray, newtons: float) -> np.ndarray:
    """Where a touch of one frame sends the arm, from rest to rest."""
    start, count = touched.robot.pose, len(touched.robot.moves)
    touched.robot.forces = np.where(taxels, newtons, 0.0)
    touched.run(0.02)
    touched.release()
    if len(touched.robot.moves) == count:
        return np.zeros(5)
    goal = touched.robot.moves[count][1]
    touched.until("Watching")
    touched.run(0.3)
    return goal - start


def test_reflex_withdraws_further_with_more_force(start_reflex) -> None:
    for robot in ROBOTS:
        touched = start_reflex(robot, "left_arm", CentredRobot, **QUICK)
        near = touched.near(touched.field("lower_arm_under"), 0.01)
        far = [np.abs(withdrawal(touched, near, n)).max() for n in (0.04, 0.06, 0.1, 0.3, 0.5, 5.0)]
        assert far == sorted(far)
        assert far[0] == 0.0
        assert (
            len(set(far)) == 5
        )  # nothing below the threshold, no more than all above the full force
        assert far[-1] == far[-2]


def test_reflex_withdraws_further_near_field_centre(start_reflex) -> None:
    for robot in ROBOTS:
        touched = start_reflex(robot, "left_arm", CentredRobot, **QUICK)
        name = "lower_arm_outer"
        touched.reflex.setFields([f for f in touched.reflex.getFields() if f.name == name])
        field, geometry = touched.field(name), touched.robot.geometry
        limb = geometry.limb == geometry.limbs.index(f"left_arm/{field.limb}")
        away = np.linalg.norm(geometry.points - field.centre, axis=1)
        mine = np.flatnonzero(limb)[np.argsort(away[limb])]
        mine = mine[np.linspace(0, len(mine) - 1, 20).astype(int)]
        far = []
        for taxel in mine:
            pressed = np.arange(geometry.size) == taxel
            far.append(np.abs(withdrawal(touched, pressed, 5.0)).max())
        outside = away[mine] >= field.radius
        assert outside.any()
        assert not outside.all()
        assert far == sorted(far, reverse=True)
        assert len(set(far)) > 5
        assert [not f for f in far] == outside.tolist()


def test_reflex_ignores_touch_below_threshold_and_outside_fields(touched) -> None:
    geometry = touched.robot.geometry
    touched.robot.forces = np.full(geometry.size, 0.049)
    touched.run(1.0)
    assert touched.robot.moves == []
    inside = np.zeros(geometry.size, bool)
    for field in touched.robot.part.fields:
        inside |= touched.near(field, field.radius + 0.02)
    other = np.array([geometry.limbs[i].startswith(touched.robot.side) for i in geometry.limb])
    touched.robot.forces = np.where(other & inside, 0.0, 50.0)
    touched.run(1.0)
    assert touched.robot.moves == []
    assert touched.reflex.getStatistics().withdrawals == 0


def test_reflex_ignores_touch_of_other_arm(touched) -> None:
    geometry = touched.robot.geometry
    other = np.array([not geometry.limbs[i].startswith(touched.robot.side) for i in geometry.limb])
    assert other.any()
    touched.robot.forces = np.where(other, 10.0, 0.0)
    touched.run(1.0)
    assert touched.robot.moves == []


def test_reflex_adds_two_simultaneous_touches(touched) -> None:
    a, b = touched.field("lower_arm_under"), touched.field("upper_arm_front")
    first = withdrawal(touched, touched.near(a, 0.01), 5.0)
    touched.run(1.0)
    other = withdrawal(touched, touched.near(b, 0.01), 5.0)
    touched.run(1.0)
    both = withdrawal(touched, touched.near(a, 0.01) | touched.near(b, 0.01), 5.0)
    assert np.abs(first).max() > 0.1
    assert np.abs(other).max() > 0.1
    assert both == pytest.approx(first + other, abs=1e-9)


def test_reflex_separates_touches_on_both_sides_of_limb(touched) -> None:
    """One mean of both would lie inside the limb, where no field is."""
    a, b = touched.field("lower_arm_outer"), touched.field("lower_arm_inner")
    first = withdrawal(touched, touched.near(a, 0.01), 5.0)
    touched.run(1.0)
    other = withdrawal(touched, touched.near(b, 0.01), 5.0)
    touched.run(1.0)
    both = withdrawal(touched, touched.near(a, 0.01) | touched.near(b, 0.01), 5.0)
    assert both == pytest.approx(first + other, abs=1e-9)


def test_reflex_adds_touch_during_withdrawal(touched) -> None:
    start = touched.robot.pose
    touched.press("lower_arm_under", 5.0)
    touched.run(0.02)
    alone = touched.robot.moves[-1][1] - start
    touched.press("upper_arm_front", 5.0)
    touched.run(0.02)
    assert touched.state == "Withdrawing"
    both = touched.robot.moves[-1][1] - start
    assert len(touched.robot.moves) == 2
    touched.release()
    assert np.abs(both - alone).max() > 0.1
    touched.until("Holding")
    assert touched.robot.pose - start == pytest.approx(both, abs=0.03)
    assert touched.reflex.getStatistics().withdrawals == 1


def test_reflex_follows_growing_but_not_fading_touch(
    touched,
) -> None:
    start, near = touched.robot.pose, touched.near(touched.field("lower_arm_under"), 0.01)
    for newtons in (0.1, 0.2, 0.4, 0.3, 0.1):
        touched.robot.forces = np.where(near, newtons, 0.0)
        touched.run(0.02)
    far = [np.abs(goal - start).max() for _, goal, _ in touched.robot.moves]
    assert len(far) == 3
    assert far == sorted(far)
    assert touched.reflex.getStatistics().withdrawals == 1


def test_reflex_withdraws_further_while_holding(touched) -> None:
    touched.press("lower_arm_under", 0.2)
    touched.run(0.04)
    touched.release()
    touched.until("Holding")
    moves = len(touched.robot.moves)
    touched.press("lower_arm_under", 5.0)
    touched.run(0.02)
    assert touched.state == "Withdrawing"
    assert len(touched.robot.moves) == moves + 1


def test_reflex_withdraws_from_touch_while_returning(start_reflex) -> None:
    touched = start_reflex("icub_v2", "left_arm", CentredRobot, refractory=0.5, hold=0.1)
    touched.press("lower_arm_under", 5.0)
    touched.run(0.04)
    touched.release()
    touched.until("Returning")
    touched.run(0.3)
    here = touched.robot.pose
    touched.press("upper_arm_front", 5.0)
    touched.run(0.02)
    assert touched.state == "Withdrawing"
    field = touched.field("upper_arm_front")
    moved = touched.robot.moves[-1][1] - here
    share = moved[0] / field.motion[0]
    assert moved == pytest.approx(share * field.motion, abs=0.02)
    assert touched.reflex.getStatistics().withdrawals == 2


def test_reflex_withdraws_again_from_lasting_touch_after_refractory_time(touched) -> None:
    touched.press("lower_arm_under", 0.2)
    touched.run(0.98)
    assert touched.reflex.getStatistics().withdrawals == 1
    assert touched.state == "Holding"  # it is still touched
    touched.run(0.1)
    assert touched.reflex.getStatistics().withdrawals == 2


def test_reflex_ignores_dead_patch_and_uses_others(touched) -> None:
    geometry = touched.robot.geometry
    dead = geometry.patch == geometry.patches.index(
        f"{touched.robot.side.removesuffix('_arm')}_lower_arm"
    )
    assert dead.any()
    touched.press("lower_arm_under", 5.0)
    touched.robot.forces[dead] = 0.0
    touched.run(0.5)
    assert touched.robot.moves == []
    assert touched.state == "Watching"
    touched.press("upper_arm_front", 5.0)
    touched.robot.forces[dead] = 0.0
    touched.run(0.04)
    assert touched.state == "Withdrawing"


def test_reflex_tolerates_single_lost_frames(touched) -> None:
    """Two of three are lost all the time; the touch is in one that comes."""
    touched.robot.spoil = lambda frame: frame if frame.sequence % 3 == 0 else None
    touched.run(1.0)
    assert touched.state == "Watching"
    touched.press("lower_arm_under", 5.0)
    touched.run(0.06)
    assert touched.state == "Withdrawing"
    touched.release()
    touched.until("Watching")
    seen = touched.reflex.getStatistics()
    assert seen.withdrawals == 1
    assert seen.framesOutOfOrder == 0


def test_reflex_gives_up_on_blocked_arm(touched) -> None:
    touched.press("lower_arm_under", 5.0)
    touched.run(0.02)
    touched.release()
    touched.robot.speed = np.zeros(5)
    touched.run(1.0)
    assert touched.state == "Withdrawing"
    touched.until("Watching", 4.0)


def test_reflex_only_watches_while_disabled(touched) -> None:
    touched.reflex.enable(False)
    touched.press("lower_arm_under", 5.0)
    touched.run(0.5)
    assert touched.robot.moves == []
    touched.reflex.enable(True)
    touched.run(0.02)
    assert len(touched.robot.moves) == 1


def test_reflex_completes_withdrawal_when_disabled(touched) -> None:
    touched.press("lower_arm_under", 5.0)
    touched.run(0.04)
    touched.reflex.enable(False)
    touched.until("Watching")
    assert touched.robot.pose == pytest.approx(touched.robot.rest, abs=0.03)


def test_reflex_applies_changed_forces_and_fields(touched) -> None:
    touched.reflex.setForces(6.0, 12.0)
    assert (touched.worker().params.threshold, touched.worker().params.full) == (6.0, 12.0)
    touched.press("lower_arm_under", 5.0)
    touched.run(0.5)
    assert touched.robot.moves == []
    touched.reflex.setForces(0.5, 1.0)
    field = touched.field("lower_arm_under")
    motion = np.array([0.0, 0.0, 0.2, 0.0, 0.0])
    limb = f"{touched.robot.side}/{field.limb}"
    mine = interfaces.Field("mine", limb, *field.centre.tolist(), 0.04, motion)
    touched.reflex.setFields([mine])
    assert [(f.name, f.limb, f.radius) for f in touched.reflex.getFields()] == [
        ("mine", limb, 0.04)
    ]
    start = touched.robot.pose
    touched.run(0.02)
    moved = touched.robot.moves[0][1] - start
    assert 0.1 < moved[2] <= 0.2
    assert np.delete(moved, 2) == pytest.approx(0.0)


def test_reflex_applies_changed_machine_parameters(touched) -> None:
    params = touched.worker().params
    with pytest.raises(
        ParameterRejected, match=r"`threshold`, 0.6 N, must be less than `full`, 0.5 N"
    ):
        params.set({"threshold": 0.6})
    params.set({"threshold": 0.6, "full": 3.0, "hold": 0.2, "withdraw_speed": 0.5})
    touched.press("lower_arm_under", 5.0)
    touched.run(0.04)
    touched.release()
    assert touched.robot.moves[0][2] == pytest.approx(0.5 * touched.robot.arm.speed_limits)
    touched.until("Holding")
    touched.run(0.26)
    assert touched.state == "Returning"


def test_reflex_joins_taxels_within_reach_to_one_touch(touched) -> None:
    """Two neighbours: one weak touch of their mean, or a weak and a strong one."""
    skin, field = touched.robot.geometry, touched.field("lower_arm_under")
    near = np.flatnonzero(touched.near(field, 0.03))
    first = near[np.argmin(np.linalg.norm(skin.points[near] - field.centre, axis=1))]
    apart = np.linalg.norm(skin.points[near] - skin.points[first], axis=1)
    touched.robot.forces[first] = 0.5
    touched.robot.forces[near[np.argsort(apart)[1]]] = 0.06
    touched.run(0.02)
    (response,) = [e for e in touched.robot.heard if isinstance(e, interfaces.Event)]
    assert 0.2 < response.force < 0.35
    touched.worker().params.set({"reach": 0.002})
    touched.run(0.02)
    events = [e for e in touched.robot.heard if isinstance(e, interfaces.Event)]
    assert max(e.force for e in events) == pytest.approx(0.5)


def test_reflex_events_report_response_and_state(touched) -> None:
    touched.press("lower_arm_under", 5.0)
    touched.run(0.02)
    touched.release()
    touched.until("Watching")
    heard = touched.robot.heard
    states = [message for message in heard if isinstance(message, interfaces.ReflexState)]
    assert [state.name for state in states] == [
        "Watching",
        "Withdrawing",
        "Holding",
        "Returning",
        "Watching",
    ]
    event = next(message for message in heard if isinstance(message, interfaces.Event))
    field = touched.field("lower_arm_under")
    assert (event.field, event.limb) == (field.name, f"{touched.robot.side}/{field.limb}")
    assert event.force == pytest.approx(5.0)
    assert event.gain == pytest.approx(1 - event.distance / field.radius)
    assert event.motion == pytest.approx(event.gain * field.motion)
    assert np.array([event.x, event.y, event.z]) == pytest.approx(field.centre, abs=0.01)
    assert event.time == pytest.approx(0.71, abs=0.011)


TOUCHES = st.lists(
    st.tuples(st.integers(0, 4), st.floats(0.0, 3.0), st.integers(1, 12), st.integers(0, 25)),
    max_size=8,
)


@pytest.mark.parametrize(("robot", "side"), ARMS)
def test_reflex_keeps_limits_and_speeds_with_random_touches(robot: str, side: str) -> None:
    touched = ReflexHarness(robot, side, refractory=0.1, hold=0.05, full=1.0).awake()
    names = [field.name for field in touched.robot.part.fields]

    @settings(max_examples=25)
    @given(TOUCHES)
    def play(touches: list[tuple[int, float, int, int]]) -> None:
        for which, newtons, frames, pause in touches:
            touched.press(names[which], newtons, 0.02)
            touched.run(0.02 * frames)
            touched.release()
            touched.run(0.02 * pause)

    try:
        play()
        robot_ = touched.robot
        assert robot_.moves
        poses = np.array(robot_.poses)
        assert (poses >= robot_.arm.low).all()
        assert (poses <= robot_.arm.high).all()
        for _, goal, speed in robot_.moves:
            assert (goal >= robot_.arm.low).all()
            assert (goal <= robot_.arm.high).all()
            assert (speed <= robot_.arm.speed_limits).all()
        assert touched.state != "Frozen"
    finally:
        touched.close()
