"""How far a touch sends the arm, at the component's ports."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.touch.kinematic_robot import ARMS, ROBOTS, CentredRobot, ReflexHarness

QUICK = {"refractory": 0.0, "hold": 0.02, "return_speed": 1.0}


def withdrawal(harness: ReflexHarness, taxels: np.ndarray, newtons: float) -> np.ndarray:
    """Where a touch of one frame sends the arm, from rest to rest."""
    start, count = harness.robot.pose, len(harness.robot.moves)
    harness.robot.forces = np.where(taxels, newtons, 0.0)
    harness.run(0.02)
    harness.release()
    if len(harness.robot.moves) == count:
        return np.zeros(5)
    goal = harness.robot.moves[count][1]
    harness.run_until("Watching")
    harness.run(0.3)
    return goal - start


def test_reflex_withdraws_further_with_more_force(start_reflex) -> None:
    for robot in ROBOTS:
        harness = start_reflex(robot, "left_arm", CentredRobot, **QUICK).wait_until_watching()
        near = harness.taxels_near(harness.field("lower_arm_under"), 0.01)
        forces = (0.04, 0.06, 0.1, 0.3, 0.5, 5.0)
        far = [np.abs(withdrawal(harness, near, newtons)).max() for newtons in forces]
        below_threshold, *between, full, above_full = far
        assert below_threshold == 0.0
        assert (np.diff([below_threshold, *between, full]) > 1e-3).all()
        assert above_full == pytest.approx(full)


def test_reflex_withdraws_further_near_field_centre(start_reflex) -> None:
    for robot in ROBOTS:
        harness = start_reflex(robot, "left_arm", CentredRobot, **QUICK).wait_until_watching()
        name = "lower_arm_outer"
        harness.reflex.setFields([f for f in harness.reflex.getFields() if f.name == name])
        field, geometry = harness.field(name), harness.robot.geometry
        limb = geometry.limb == geometry.limbs.index(f"left_arm/{field.limb}")
        away = np.linalg.norm(geometry.points - field.centre, axis=1)
        mine = np.flatnonzero(limb)[np.argsort(away[limb])]
        mine = mine[np.linspace(0, len(mine) - 1, 20).astype(int)]
        far = []
        for taxel in mine:
            pressed = np.arange(geometry.size) == taxel
            far.append(np.abs(withdrawal(harness, pressed, 5.0)).max())
        outside = away[mine] >= field.radius
        assert outside.any()
        assert not outside.all()
        assert (np.diff(far) < 1e-12).all()
        assert len(set(far)) > 5
        assert [not f for f in far] == outside.tolist()


def test_reflex_ignores_touch_below_threshold_and_outside_fields(centred_harness) -> None:
    geometry = centred_harness.robot.geometry
    centred_harness.robot.forces = np.full(geometry.size, 0.049)
    centred_harness.run(1.0)
    assert centred_harness.robot.moves == []
    inside = np.zeros(geometry.size, bool)
    for field in centred_harness.robot.part.fields:
        inside |= centred_harness.taxels_near(field, field.radius + 0.02)
    other = np.array(
        [geometry.limbs[i].startswith(centred_harness.robot.side) for i in geometry.limb]
    )
    centred_harness.robot.forces = np.where(other & inside, 0.0, 50.0)
    centred_harness.run(1.0)
    assert centred_harness.robot.moves == []
    assert centred_harness.reflex.getStatistics().withdrawals == 0


def test_reflex_ignores_touch_of_other_arm(centred_harness) -> None:
    geometry = centred_harness.robot.geometry
    other = np.array(
        [not geometry.limbs[i].startswith(centred_harness.robot.side) for i in geometry.limb]
    )
    assert other.any()
    centred_harness.robot.forces = np.where(other, 10.0, 0.0)
    centred_harness.run(1.0)
    assert centred_harness.robot.moves == []


def test_reflex_adds_two_simultaneous_touches(centred_harness) -> None:
    a, b = centred_harness.field("lower_arm_under"), centred_harness.field("upper_arm_front")
    first = withdrawal(centred_harness, centred_harness.taxels_near(a, 0.01), 5.0)
    centred_harness.run(1.0)
    other = withdrawal(centred_harness, centred_harness.taxels_near(b, 0.01), 5.0)
    centred_harness.run(1.0)
    both = withdrawal(
        centred_harness,
        centred_harness.taxels_near(a, 0.01) | centred_harness.taxels_near(b, 0.01),
        5.0,
    )
    assert np.abs(first).max() > 0.1
    assert np.abs(other).max() > 0.1
    assert both == pytest.approx(first + other, abs=1e-9)


def test_reflex_separates_touches_on_both_sides_of_limb(centred_harness) -> None:
    """One mean of both would lie inside the limb, where no field is."""
    a, b = centred_harness.field("lower_arm_outer"), centred_harness.field("lower_arm_inner")
    first = withdrawal(centred_harness, centred_harness.taxels_near(a, 0.01), 5.0)
    centred_harness.run(1.0)
    other = withdrawal(centred_harness, centred_harness.taxels_near(b, 0.01), 5.0)
    centred_harness.run(1.0)
    both = withdrawal(
        centred_harness,
        centred_harness.taxels_near(a, 0.01) | centred_harness.taxels_near(b, 0.01),
        5.0,
    )
    assert both == pytest.approx(first + other, abs=1e-9)


def test_reflex_adds_touch_during_withdrawal(centred_harness) -> None:
    start = centred_harness.robot.pose
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.02)
    alone = centred_harness.robot.moves[-1][1] - start
    centred_harness.press("upper_arm_front", 5.0)
    centred_harness.run(0.02)
    assert centred_harness.state == "Withdrawing"
    both = centred_harness.robot.moves[-1][1] - start
    assert len(centred_harness.robot.moves) == 2
    centred_harness.release()
    assert np.abs(both - alone).max() > 0.1
    centred_harness.run_until("Holding")
    assert centred_harness.robot.pose - start == pytest.approx(both, abs=0.03)
    assert centred_harness.reflex.getStatistics().withdrawals == 1


def test_reflex_follows_growing_but_not_fading_touch(
    centred_harness,
) -> None:
    start, near = (
        centred_harness.robot.pose,
        centred_harness.taxels_near(centred_harness.field("lower_arm_under"), 0.01),
    )
    for newtons in (0.1, 0.2, 0.4, 0.3, 0.1):
        centred_harness.robot.forces = np.where(near, newtons, 0.0)
        centred_harness.run(0.02)
    far = [np.abs(goal - start).max() for _, goal, _ in centred_harness.robot.moves]
    assert len(far) == 3
    assert (np.diff(far) > -1e-12).all()
    assert centred_harness.reflex.getStatistics().withdrawals == 1


def test_reflex_withdraws_further_while_holding(centred_harness) -> None:
    centred_harness.press("lower_arm_under", 0.2)
    centred_harness.run(0.04)
    centred_harness.release()
    centred_harness.run_until("Holding")
    moves = len(centred_harness.robot.moves)
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.02)
    assert centred_harness.state == "Withdrawing"
    assert len(centred_harness.robot.moves) == moves + 1


def test_reflex_withdraws_from_touch_while_returning(start_reflex) -> None:
    harness = start_reflex(
        "icub_v2", "left_arm", CentredRobot, refractory=0.5, hold=0.1, law="fixed"
    ).wait_until_watching()
    harness.press("lower_arm_under", 5.0)
    harness.run(0.04)
    harness.release()
    harness.run_until("Returning")
    harness.run(0.3)
    here = harness.robot.pose
    harness.press("upper_arm_front", 5.0)
    harness.run(0.02)
    assert harness.state == "Withdrawing"
    field = harness.field("upper_arm_front")
    moved = harness.robot.moves[-1][1] - here
    share = moved[0] / field.motion[0]
    assert moved == pytest.approx(share * field.motion, abs=0.02)
    assert harness.reflex.getStatistics().withdrawals == 2


def test_reflex_withdraws_again_from_lasting_touch_after_refractory_time(centred_harness) -> None:
    centred_harness.press("lower_arm_under", 0.2)
    centred_harness.run(0.98)
    assert centred_harness.reflex.getStatistics().withdrawals == 1
    assert centred_harness.state == "Holding"  # it is still centred_harness
    centred_harness.run(0.1)
    assert centred_harness.reflex.getStatistics().withdrawals == 2


def test_reflex_ignores_dead_patch_and_uses_others(centred_harness) -> None:
    geometry = centred_harness.robot.geometry
    dead = geometry.patch == geometry.patches.index(
        f"{centred_harness.robot.side.removesuffix('_arm')}_lower_arm"
    )
    assert dead.any()
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.robot.forces[dead] = 0.0
    centred_harness.run(0.5)
    assert centred_harness.robot.moves == []
    assert centred_harness.state == "Watching"
    centred_harness.press("upper_arm_front", 5.0)
    centred_harness.robot.forces[dead] = 0.0
    centred_harness.run(0.04)
    assert centred_harness.state == "Withdrawing"


def test_reflex_tolerates_single_lost_frames(centred_harness) -> None:
    """Two of three are lost all the time; the touch is in one that comes."""
    centred_harness.robot.alter_frame = lambda frame: frame if frame.sequence % 3 == 0 else None
    centred_harness.run(1.0)
    assert centred_harness.state == "Watching"
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.06)
    assert centred_harness.state == "Withdrawing"
    centred_harness.release()
    centred_harness.run_until("Watching")
    seen = centred_harness.reflex.getStatistics()
    assert seen.withdrawals == 1
    assert seen.framesOutOfOrder == 0


def test_reflex_gives_up_on_blocked_arm(centred_harness) -> None:
    centred_harness.press("lower_arm_under", 5.0)
    centred_harness.run(0.02)
    centred_harness.release()
    centred_harness.robot.speed = np.zeros(5)
    centred_harness.run(1.0)
    assert centred_harness.state == "Withdrawing"
    centred_harness.run_until("Watching", 4.0)


ROUNDING = 1e-12
"""Sums of steps may miss a limit by their rounding [rad]."""

TOUCHES = st.lists(
    st.tuples(st.integers(0, 4), st.floats(0.0, 3.0), st.integers(1, 12), st.integers(0, 25)),
    max_size=8,
)


@pytest.mark.parametrize(("robot", "side"), ARMS)
def test_reflex_keeps_limits_and_speeds_with_random_touches(robot: str, side: str) -> None:
    harness = ReflexHarness(robot, side, refractory=0.1, hold=0.05, full=1.0).wait_until_watching()
    names = [field.name for field in harness.robot.part.fields]

    @settings(max_examples=25)
    @given(TOUCHES)
    def play(touches: list[tuple[int, float, int, int]]) -> None:
        for which, newtons, frames, pause in touches:
            harness.press(names[which], newtons, 0.02)
            harness.run(0.02 * frames)
            harness.release()
            harness.run(0.02 * pause)

    try:
        play()
        robot = harness.robot
        assert robot.moves
        poses = np.array(robot.poses)
        assert (poses >= robot.arm.low - ROUNDING).all()
        assert (poses <= robot.arm.high + ROUNDING).all()
        for _, goal, speed in robot.moves:
            assert (goal >= robot.arm.low - ROUNDING).all()
            assert (goal <= robot.arm.high + ROUNDING).all()
            assert (speed <= robot.arm.speed_limits).all()
        assert harness.state != "Frozen"
    finally:
        harness.close()
