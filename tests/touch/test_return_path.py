"""The way back after several withdrawals: free of the robot's own body, at random poses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.pose_directions import PoseDirections
from robocomp_dsl.tactile.reflex.return_path import ReturnPath
from tests.touch.own_robots import SIDES
from tests.touch.withdrawal_shares import RobotPart, load_part

OVERLAP = -1e-3
"""Between two samples of a way that is free, the arm may overlap the robot this little [m]."""


@pytest.fixture(params=SIDES)
def part(request: pytest.FixtureRequest, tmp_path: Path) -> RobotPart:
    """An arm of NAO: at 4 % of its poses the straight way to the start pose is not free."""
    return load_part("nao_h25", request.param, tmp_path)


def closest(part: RobotPart, begin: Floats, end: Floats) -> float:
    """The smallest distance [m] to the robot on the straight way, sampled finely."""
    shares = np.linspace(0.0, 1.0, 60)[:, None]
    return min(part.body.clearance(angles, 0.01) for angles in begin + shares * (end - begin))


def withdraw(part: RobotPart, rng: np.random.Generator, count: int) -> list[Floats]:
    """The poses in which `count` random withdrawals began, and the last goal."""
    while part.body.clearance(pose := part.random_pose(rng), 0.01) < 0.01:
        pass
    poses = [pose]
    for _ in range(count):
        field = part.part.fields[int(rng.integers(len(part.part.fields)))]
        poses.append(part.withdrawal("pose", part.random_touch(field, rng), poses[-1]).goal)
    return poses


def test_return_path_keeps_arm_off_own_body_after_random_withdrawals(part: RobotPart) -> None:
    """The straight way to the start pose presses the arm against the robot for some of them."""
    rng, directions, start = np.random.default_rng(5), PoseDirections(part.body), part.arm.start
    blocked = overlapping = 0
    for _ in range(150):
        *begun, pose = withdraw(part, rng, 3)
        overlapping += closest(part, pose, start) < OVERLAP
        path = ReturnPath()
        for waypoint in begun:
            path.add(waypoint)
        while (goal := path.next_goal(pose, start, directions)) is not None:
            assert closest(part, pose, goal) > OVERLAP
            pose = goal
            if goal is start:
                break
        blocked += goal is None
    assert blocked < overlapping  # some returned by an earlier pose


def test_return_path_leads_back_over_earlier_poses(part: RobotPart) -> None:
    """A withdrawal around the body, as two ways that are free."""
    rng, directions = np.random.default_rng(7), PoseDirections(part.body)
    while True:
        start, between, pose = (part.random_pose(rng) for _ in range(3))
        ways = [(start, between), (between, pose), (start, pose)]
        if [directions.is_free(*way) for way in ways] == [True, True, False]:
            break
    path = ReturnPath()
    path.add(start)
    path.add(between)
    assert path.next_goal(pose, start, directions) is between
    assert path.next_goal(between, start, directions) is start


def test_return_path_goes_straight_without_a_model(part: RobotPart) -> None:
    path, start, pose = ReturnPath(), part.arm.start, part.arm.low
    path.add(part.arm.high)
    assert path.next_goal(pose, start, None) is start


def test_return_path_is_none_if_every_way_is_blocked(part: RobotPart) -> None:
    rng, directions = np.random.default_rng(6), PoseDirections(part.body)
    path, start = ReturnPath(), part.arm.start
    while True:
        pose = part.random_pose(rng)
        if part.body.clearance(pose, 0.01) > 0.0 and not directions.is_free(pose, start):
            break
    assert path.next_goal(pose, start, directions) is None
    path.add(pose)
    path.clear()
    assert path.next_goal(pose, start, directions) is None
