"""`generic_arm` in space: its chain, points and poses, and a hand that glides."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.support.waiting import wait_until
from tests.touch.arm_client import ARM, RunningArm, arm_on, refusal_of
from tests.touch.served_robot import ServedRobot

BOTH = pytest.mark.parametrize("robot", ["nao_h25", "icub_v2"])
POINT = {"nao_h25": "l_hand", "icub_v2": "l_hand"}
GOAL = np.array([0.5, 0.6, 0.3, 0.9, 0.2])


def position(pose: object) -> np.ndarray:
    return np.array([pose.x, pose.y, pose.z])


def rotation(pose: object) -> np.ndarray:
    return np.array([[getattr(pose, f"r{i}{j}") for j in range(3)] for i in range(3)])


def pose_by_chain(arm: RunningArm, angles: np.ndarray) -> np.ndarray:
    """What anybody can work out who has asked for the chain: Rz Tz Tx Rx, row by row."""
    chain = arm.getChain()
    pose = chain.base.reshape(4, 4)
    for row in chain.rows:
        turn = row.offset + (angles[row.joint] if row.joint >= 0 else 0.0)
        c, s, ca, sa = np.cos(turn), np.sin(turn), np.cos(row.alpha), np.sin(row.alpha)
        pose = pose @ np.array(
            [
                [c, -s * ca, s * sa, row.a * c],
                [s, c * ca, -c * sa, row.a * s],
                [0, sa, ca, row.d],
                [0, 0, 0, 1],
            ]
        )
    return pose @ chain.tool.reshape(4, 4)


def hand_of(served: ServedRobot, robot: str) -> np.ndarray:
    """Where physics has the hand, in the frame of the robot's root."""
    data = served.world.data
    mujoco.mj_forward(served.world.model, data)
    root = data.body(served.robot.links[0].name)
    return root.xmat.reshape(3, 3).T @ (data.site(POINT[robot]).xpos - root.xpos)


@BOTH
def test_generic_arm_chain_places_hand_like_physics(robot: str) -> None:
    with arm_on(robot) as (arm, served):
        arm.move(GOAL, np.zeros(0))
        angles = arm.wait_for_rest().position
        served.ticking = False
        hand = arm.getHand()
        by_chain = pose_by_chain(arm, arm.getState().position)
        assert position(hand) == pytest.approx(by_chain[:3, 3], abs=1e-9)
        assert rotation(hand) == pytest.approx(by_chain[:3, :3], abs=1e-9)
        assert angles == pytest.approx(GOAL, abs=0.05)
        assert position(hand) == pytest.approx(hand_of(served, robot), abs=0.002)


@BOTH
def test_generic_arm_moves_hand_to_points_and_poses(robot: str) -> None:
    with arm_on(robot) as (arm, _):
        goal = pose_by_chain(arm, GOAL)
        outcome = arm.reach(*goal[:3, 3].tolist())
        assert not outcome.clipped.any()
        arm.wait_for_rest()
        assert position(arm.getHand()) == pytest.approx(goal[:3, 3], abs=0.006)
        pose = ARM.interfaces.Pose(*goal[:3, 3].tolist(), *goal[:3, :3].ravel().tolist())
        arm.reachPose(pose)
        arm.wait_for_rest()
        assert position(arm.getHand()) == pytest.approx(goal[:3, 3], abs=0.006)
        assert rotation(arm.getHand()) == pytest.approx(goal[:3, :3], abs=0.05)


@BOTH
def test_generic_arm_reports_distance_of_unreachable_goal(robot: str) -> None:
    with arm_on(robot, "begin=nothing") as (arm, served):
        with pytest.raises(ARM.interfaces.Unreachable) as far:
            arm.reach(2.0, 0.0, 0.0)
        assert far.value.distance > 1.0
        assert "mm" in far.value.what
        hand = arm.getHand()
        assert "three finite" in refusal_of(arm.reach, np.nan, 0.0, 0.0)
        hand.r00 += 0.5
        assert "orthonormal columns" in refusal_of(arm.reachPose, hand)
        assert {operation for _, operation in served.calls} == {"getJoints", "getState"}


@BOTH
def test_generic_arm_moves_hand_along_line_until_stopped(robot: str) -> None:
    with arm_on(robot) as (arm, _):
        arm.move(GOAL, np.zeros(0))
        arm.wait_for_rest()
        first = position(arm.getHand())
        way = np.array([0.0, 0.0, 0.05])  # up
        arm.glide(*way.tolist())
        wait_until(lambda: position(arm.getHand())[2] > first[2] + 0.04)
        gone = position(arm.getHand()) - first
        assert gone[:2] == pytest.approx(0, abs=0.012)
        arm.stop()
        arm.wait_for_rest()
        there = arm.getState()
        wait_until(lambda: arm.states[-1].time > there.time + 0.3)
        assert arm.getState().position == pytest.approx(there.position, abs=0.03)


def test_generic_arm_ends_line_motion_after_hold_without_renewal() -> None:
    with arm_on("icub_v2", "hold=0.3") as (arm, _):
        arm.move(GOAL, np.zeros(0))
        arm.wait_for_rest()
        first = position(arm.getHand())
        arm.start_motion(arm.glide, 0.0, 0.0, 0.05)
        arm.wait_for_rest()
        assert position(arm.getHand())[2] > first[2] + 0.001
        assert arm.runner.worker.control._glide is None
