"""The component `generic_arm` on the boards of two robots: the same arm on both."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode
from tests.support.waiting import wait_until
from tests.touch.arm_client import arm_on, refusal_of
from tests.touch.served_robot import ServedRobot

ROBOTS = ("nao_h25", "icub_v2")
GOAL = np.array([0.5, 0.6, 0.3, 0.9, 0.2])
STEP = np.array([-0.2, 0.1, 0, -0.3, 0.1])
ELBOW = np.array([0.0, 0, 0, 1, 0])
NONE = np.zeros(0)
BOTH = pytest.mark.parametrize("robot", ROBOTS)


@BOTH
def test_generic_arm_publishes_its_position(robot: str) -> None:
    """The robots stand in the start pose of their descriptions."""
    with arm_on(robot) as (arm, _):
        limits, state = arm.getLimits(), arm.getState()
        assert limits.available.all()
        assert state.position == pytest.approx(limits.start, abs=0.05)
        wait_until(lambda: len(arm.states) > 3)
        times = [published.time for published in arm.states]
        assert times == sorted(set(times))


def test_generic_arm_commands_give_same_angles_on_all_robots() -> None:
    ends = []
    for robot in ROBOTS:
        with arm_on(robot) as (arm, served):
            served.ticking = False  # or it might be there before it is asked whether it moves
            outcome = arm.move(GOAL, np.full(5, 1.5))
            assert not outcome.clipped.any()
            assert not outcome.dropped.any()
            assert arm.getState().moving
            served.ticking = True
            first = arm.wait_for_rest().position
            arm.moveBy(STEP, NONE)
            ends.append((first, arm.wait_for_rest().position))
    (nao, nao_by), (icub, icub_by) = ends
    assert nao == pytest.approx(GOAL, abs=0.02)
    assert nao == pytest.approx(icub, abs=0.03)
    assert nao_by == pytest.approx(GOAL + STEP, abs=0.04)
    assert nao_by == pytest.approx(icub_by, abs=0.05)


@BOTH
def test_generic_arm_respects_speeds_and_clips_goals(robot: str) -> None:
    with arm_on(robot) as (arm, _):
        limits = arm.getLimits()
        arm.move(limits.start + 0.4 * ELBOW, np.array([1, 1, 1, 0.2, 1]))
        arm.wait_for_rest()
        fastest = max(abs(state.velocity[3]) for state in arm.states)
        assert 0.2 < fastest < 0.2 * 2.2  # minimum jerk peaks at 1.875 of its mean
        outcome = arm.move(np.array([9.0, 0.6, 0.3, 9.0, 0.2]), NONE)
        assert outcome.clipped.tolist() == [True, False, False, True, False]
        there = arm.wait_for_rest().position
        assert there[[0, 3]] == pytest.approx(limits.high[[0, 3]], abs=0.06)


def test_generic_arm_reads_sigma_and_drops_commands_of_missing_joints() -> None:
    with arm_on("nao_h21") as (arm, _):
        limits = arm.getLimits()
        assert limits.available.tolist() == [True] * 4 + [False]
        assert limits.low[4] == limits.high[4] == limits.speed[4] == 0.0
        outcome = arm.move(GOAL, NONE)
        assert outcome.dropped.tolist() == [False] * 4 + [True]
        assert not outcome.clipped.any()
        state = arm.wait_for_rest()
        assert state.position == pytest.approx([*GOAL[:4], 0.0], abs=0.03)
        assert state.velocity[4] == state.torque[4] == 0.0


@BOTH
def test_generic_arm_refuses_invalid_commands_unchanged(robot: str) -> None:
    with arm_on(robot) as (arm, served):
        before = len([call for call in served.calls if call[1] == "positionMove"])
        assert "5 values are needed, not 3" in refusal_of(arm.move, np.zeros(3), NONE)
        assert "NaN" in refusal_of(arm.move, np.full(5, np.nan), NONE)
        assert "above 0" in refusal_of(arm.move, GOAL, np.zeros(5))
        assert "5 finite displacements" in refusal_of(arm.moveBy, NONE, NONE)
        assert "must not be negative" in refusal_of(arm.setStiffness, np.full(5, -1.0), np.ones(5))
        assert "5 values are needed, not 0" in refusal_of(arm.setStiffness, np.ones(5), NONE)
        arm.drive(np.full(5, np.inf))
        arm.push(np.zeros(2))
        arm.follow(np.zeros(0))
        arm.glide(np.nan, 0.0, 0.0)
        position = arm.getState().position
        wait_until(lambda: len(arm.states) > 30)
        assert arm.getState().position == pytest.approx(position, abs=0.01)
        assert len([call for call in served.calls if call[1] == "positionMove"]) == before


@BOTH
def test_generic_arm_velocity_lasts_until_next_command(robot: str) -> None:
    with arm_on(robot) as (arm, _):
        start = arm.getState().position
        arm.drive(np.array([0, 0.3, 0, 0.4, 0]))
        wait_until(lambda: arm.getState().position[3] > start[3] + 0.3)
        state = arm.getState()
        assert state.moving
        assert state.velocity[[1, 3]] == pytest.approx([0.3, 0.4], abs=0.1)
        assert state.velocity[[0, 2, 4]] == pytest.approx(0, abs=0.1)
        arm.stop()
        rest = arm.wait_for_rest()
        assert rest.position[0] == pytest.approx(start[0], abs=0.03)
        wait_until(lambda: len(arm.states) and arm.states[-1].time > rest.time + 0.3)
        assert arm.getState().position == pytest.approx(rest.position, abs=0.02)


@BOTH
def test_generic_arm_ends_velocity_after_hold_without_renewal(robot: str) -> None:
    with arm_on(robot, "hold=0.2") as (arm, _):
        arm.start_motion(arm.drive, np.array([0, 0, 0, 0.5, 0]))
        there = arm.wait_for_rest().position
        assert there[3] < arm.getLimits().high[3] - 0.1


@BOTH
def test_generic_arm_follows_position_stream(robot: str) -> None:
    with arm_on(robot) as (arm, _):
        start = arm.getState().position
        for step in range(1, 101):
            seen = len(arm.states)
            arm.follow(start + 0.004 * step * ELBOW)
            wait_until(lambda seen=seen: len(arm.states) > seen)
        wait_until(lambda: abs(arm.getState().position[3] - start[3] - 0.4) < 0.03)
        # and a move starts from there
        arm.move(start, NONE)
        assert arm.wait_for_rest().position == pytest.approx(start, abs=0.05)


@BOTH
def test_generic_arm_pushed_joint_turns_in_push_direction(robot: str) -> None:
    """Torque follows power: the generic elbow flexes under a positive torque on every robot."""
    with arm_on(robot) as (arm, _):
        before = arm.getState().position
        del arm.states[:]
        torque = {"nao_h25": 0.8, "icub_v2": 3.0}[robot] * ELBOW
        wait_until(lambda: arm.push(torque) or arm.getState().position[3] > before[3] + 0.15)
        assert max(state.torque[3] for state in arm.states) > 0
        arm.stop()
        rest = arm.wait_for_rest()
        wait_until(lambda: arm.states[-1].time > rest.time + 0.3)
        assert arm.getState().position == pytest.approx(rest.position, abs=0.05)


@BOTH
def test_generic_arm_holds_position_when_push_is_not_renewed(robot: str) -> None:
    """The board of the test lets joints be pushed for ever: it is the arm that ends it."""
    with arm_on(robot, "push_hold=0.2") as (arm, served):
        arm.push({"nao_h25": 0.4, "icub_v2": 1.5}[robot] * ELBOW)
        wait_until(lambda: "setTorque" in {operation for _, operation in served.calls})
        wait_until(lambda: elbow(served) is Mode.POSITION)
        rest = arm.wait_for_rest()
        wait_until(lambda: arm.states[-1].time > rest.time + 0.3)
        assert arm.getState().position == pytest.approx(rest.position, abs=0.05)


def elbow(served: ServedRobot) -> Mode:
    """The control mode of the joint behind generic index 3."""
    board = served.part.board
    (row,) = {"LElbowRoll", "l_elbow"}.intersection(board.spec.names)
    return board.state().modes[board.spec.names.index(row)]


@BOTH
def test_generic_arm_sets_stiffness_in_device_units(robot: str) -> None:
    with arm_on(robot) as (arm, served):
        arm.setStiffness(np.full(5, 6.0), np.full(5, 0.3))
        board = served.part.board
        joints = [joint.rpartition("/")[2] for joint in arm.runner.worker.arm.part.joints]
        rows = [board.spec.names.index(name) for name in joints]
        assert [board.table.interactions[row].value for row in rows] == ["comp"] * 5
        assert board.impedance.stiffness[rows] == pytest.approx(6.0)
        assert board.impedance.damping[rows] == pytest.approx(0.3)
        message = refusal_of(arm.setStiffness, np.array([5.0, 5, 5, 5, 1e6]), np.zeros(5))
        assert "`board`" in message
        assert joints[4] in message
        assert board.impedance.stiffness[rows] == pytest.approx(6.0)
        arm.setStiffness(NONE, NONE)
        assert [board.table.interactions[row].value for row in rows] == ["stif"] * 5


@BOTH
def test_generic_arm_begins_as_configured(robot: str) -> None:
    with arm_on(robot, "begin=nothing") as (arm, served):
        kinds = {operation for _, operation in served.calls}
        assert kinds == {"getJoints", "getState"}
    with arm_on(robot, "begin=start", "compliant=true") as (arm, served):
        asked = [operation for _, operation in served.calls]
        assert {"setImpedance", "setInteractionMode", "positionMove"} <= set(asked)
        assert arm.wait_for_rest().position == pytest.approx(arm.getLimits().start, abs=0.25)


BEYOND = {"nao_h25": {"LHand": 0.8}, "icub_v2": {"l_wrist_pitch": -0.6, "l_wrist_yaw": 0.3}}


@BOTH
def test_generic_arm_moves_other_joints_to_initial_positions(robot: str) -> None:
    with arm_on(robot, pose=BEYOND[robot]) as (arm, served):
        board = served.part.board
        rows = [board.spec.names.index(name) for name in BEYOND[robot]]
        wait_until(lambda: np.abs(board.position[rows]).max() < 0.02)
        arm.move(GOAL, NONE)
        arm.wait_for_rest()
        assert board.position[rows] == pytest.approx(0, abs=0.03)
        assert arm.getState().position == pytest.approx(GOAL, abs=0.05)
    with arm_on(robot, "begin=nothing", pose=BEYOND[robot]) as (arm, served):
        arm.move(GOAL, NONE)
        arm.wait_for_rest()
        held = [served.part.board.position[row] for row in rows]
        assert held == pytest.approx(list(BEYOND[robot].values()), abs=0.05)


@BOTH
def test_generic_arm_live_parameters_change_speed_and_rate(robot: str) -> None:
    with arm_on(robot) as (arm, _):
        full = arm.getLimits().speed
        arm.runner.params.set({"speed": 0.1, "period": 5})
        assert arm.getLimits().speed == pytest.approx(0.1 * full)
        assert arm.runner.lifecycle.period_ms == 5
        outcome = arm.move(arm.getLimits().start + 0.3 * ELBOW, np.full(5, 100.0))
        assert not outcome.clipped.any()
        del arm.states[:]
        arm.wait_for_rest()
        assert max(abs(state.velocity[3]) for state in arm.states) <= 0.1 * full[3] * 1.3
