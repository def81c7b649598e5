"""Withdrawals over random poses: the law `pose` never moves the arm towards the finger."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.tactile.reflex.withdrawal import LimitCause
from tests.touch.own_robots import SIDES
from tests.touch.withdrawal_shares import ROBOTS, RobotPart, load_part, shares

ARMS = pytest.mark.parametrize(
    ("robot", "side"), [(robot, side) for robot in ROBOTS for side in SIDES]
)


@pytest.fixture
def part(robot: str, side: str, tmp_path: Path) -> RobotPart:
    return load_part(robot, side, tmp_path)


@ARMS
def test_pose_law_never_withdraws_towards_touch_at_300_random_poses(part: RobotPart) -> None:
    """Before, 16 to 22 % of the motions of fields did; the law `fixed` still does."""
    for field in part.part.fields:
        found = shares(part, "pose", field)
        assert found.towards == 0.0, field.name
        assert found.median > 0.005, field.name


@ARMS
def test_fixed_law_withdraws_towards_touch_at_some_poses(part: RobotPart) -> None:
    """The test above can fail."""
    towards = [shares(part, "fixed", field, 60).towards for field in part.part.fields]
    assert max(towards) > 0.2


@ARMS
def test_pose_law_keeps_limits_and_length_of_motion(part: RobotPart) -> None:
    rng = np.random.default_rng(3)
    for field in part.part.fields:
        pose = part.random_pose(rng)
        touch = part.random_touch(field, rng)
        goal = part.withdrawal("pose", touch, pose).goal
        assert (goal >= part.arm.low - 1e-12).all()
        assert (goal <= part.arm.high + 1e-12).all()
        assert np.linalg.norm(goal - pose) <= np.linalg.norm(field.motion) + 1e-9


@ARMS
def test_pose_law_does_not_approach_own_body(part: RobotPart) -> None:
    rng = np.random.default_rng(4)
    for _ in range(100):
        pose = part.random_pose(rng)
        before = part.body.clearance(pose, 0.01)
        if before < 0.0:
            continue
        field = part.part.fields[int(rng.integers(len(part.part.fields)))]
        plan = part.withdrawal("pose", part.random_touch(field, rng), pose)
        for share in np.linspace(0.0, 1.0, 9):
            angles = pose + share * (plan.goal - pose)
            assert part.body.clearance(angles, 0.01) >= min(before, 0.01) - 1e-3


@pytest.mark.parametrize(("robot", "side"), [("nao_h25", "left_arm"), ("icub_v2", "right_arm")])
@pytest.mark.parametrize("law", ["fixed", "pose"])
def test_laws_use_remaining_joints_with_joints_of_field_at_limits(part: RobotPart, law) -> None:
    field = next(field for field in part.part.fields if field.name == "lower_arm_under")
    pose = part.arm.start.copy()
    moving = np.flatnonzero(field.motion)
    limits = np.where(field.motion > 0.0, part.arm.high, part.arm.low)
    pose[moving] = limits[moving]
    rng = np.random.default_rng(5)
    touch = part.random_touch(field, rng)
    if law == "fixed":
        part.laws["fixed"] = type(part.laws["fixed"])(part.laws["pose"].directions)
    found = part.withdrawal(law, touch, pose)
    assert part.progress(law, touch, pose) > 0.002
    if law == "fixed":
        assert found.limit is LimitCause.JOINT_LIMITS
        assert np.abs((found.goal - pose)[~np.isin(np.arange(len(pose)), moving)]).max() > 0.05
