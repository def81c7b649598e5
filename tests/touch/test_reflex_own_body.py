"""The reflex and the robot's own body: no withdrawal into it, none from contacts with it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.models.body_model import BodyModel
from robocomp_dsl.simulation.robots.catalog import description
from tests.touch.kinematic_robot import DESCRIPTIONS, ReflexHarness, interfaces
from tests.touch.physical_robot import PhysicalRobot

NEXT_TO_BODY = {
    "hanging": ("lower_arm_outer", (-0.19, 0.1, 0.03, 0.49, -1.58)),
    "before the hip": ("lower_arm_outer", (0.06, 0.1, 0.21, 0.62, -0.97)),
    "before the face": ("lower_arm_under", (2.1, 0.02, 1.12, 1.18, -1.25)),
}
"""Fields of NAO's left arm, and generic poses in which their touch presses it to the body."""

StartAt = Callable[..., ReflexHarness]


@pytest.fixture
def start_at(start_reflex: Callable[..., ReflexHarness]) -> StartAt:
    """Starts the reflex of NAO's left arm in the last of some poses, reached in this order."""

    def start(*poses: tuple[float, ...], **params: object) -> ReflexHarness:
        forces = {"threshold": 0.03, "full": 0.12, "hold": 1.0}
        harness = start_reflex("nao_h25", "left_arm", PhysicalRobot, **{**forces, **params})
        harness.wait_until_watching()
        harness.reflex.enable(False)
        for pose in poses:
            harness.robot.move(np.array(pose), harness.robot.part.speed_limits * 0.2)
            harness.run(2.5)
        harness.robot.moves.clear()
        harness.reflex.enable(True)
        return harness

    return start


def own_force(robot: Any) -> float:
    """The sum of the normal forces [N] between the arm and the rest of the robot."""
    model, data, total, force = robot.body.model, robot.body.data, 0.0, np.zeros(6)
    for i in range(data.ncon):
        bodies = [int(model.geom_bodyid[geom]) for geom in data.contact[i].geom]
        arm = [model.body(body).name in {"LBicep", "LForeArm", "l_wrist"} for body in bodies]
        robots = [model.body_rootid[body] == model.body("torso").rootid[0] for body in bodies]
        if any(arm) and not all(arm) and all(robots):
            mujoco.mj_contactForce(model, data, i, force)
            total += abs(force[0])
    return total


def largest_own_force(harness: ReflexHarness, seconds: float) -> float:
    largest = 0.0
    for _ in range(round(seconds / 0.02)):
        harness.run(0.02)
        largest = max(largest, own_force(harness.robot))
    return largest


def without_model(tmp_path: Path) -> Path:
    """The description of NAO as it was before it named a model."""
    text = (DESCRIPTIONS / "nao_h25.yaml").read_text()
    file = tmp_path / "nao_h25.tactile.yaml"
    file.write_text("\n".join(line for line in text.splitlines() if not line.startswith("model:")))
    return file


def limits_reported(harness: ReflexHarness) -> set[str]:
    messages = harness.robot.reflex_messages
    return {m.cause.name for m in messages if isinstance(m, interfaces.Limitation)}


@pytest.mark.parametrize(("name", "pose"), NEXT_TO_BODY.values(), ids=list(NEXT_TO_BODY))
def test_reflex_does_not_press_arm_against_own_body(start_at: StartAt, name, pose) -> None:
    harness = start_at(pose)
    harness.robot.press(harness.field(name), 0.004, 0.2)
    assert largest_own_force(harness, 1.0) == 0.0
    assert harness.robot.moves, "it was felt and left alone"
    assert harness.state == "Holding"


def test_reflex_without_model_presses_arm_against_own_body(start_at: StartAt, tmp_path) -> None:
    """What the test above is about: 25 N, of which 12 N stay."""
    name, pose = NEXT_TO_BODY["before the hip"]
    harness = start_at(pose, description=without_model(tmp_path))
    harness.robot.press(harness.field(name), 0.004, 0.2)
    assert largest_own_force(harness, 1.0) > 15.0
    assert own_force(harness.robot) > 5.0


@pytest.mark.parametrize("law", ["pose", "fixed"])
def test_reflex_shortens_withdrawal_before_own_body(start_at: StartAt, law) -> None:
    name, pose = NEXT_TO_BODY["before the hip"]
    harness = start_at(pose, law=law)
    harness.robot.press(harness.field(name), 0.004, 0.2)
    assert largest_own_force(harness, 1.0) == 0.0
    assert "OwnBody" in limits_reported(harness)


def test_reflex_ignores_contact_of_robot_with_itself(start_at: StartAt, tmp_path) -> None:
    """The arm is moved against the hip by somebody else; without a model the reflex reacts."""
    pose, into_hip = NEXT_TO_BODY["before the hip"][1], np.array([0.06, -0.15, 0.66, 0.62, -0.97])
    responses = []
    for params in ({}, {"description": without_model(tmp_path)}):
        harness = start_at(pose, **params)
        harness.robot.move(into_hip, harness.robot.part.speed_limits * 0.1)
        harness.robot.moves.clear()
        assert largest_own_force(harness, 2.0) > 1.0
        assert harness.robot.peak > 0.1
        responses.append(len(harness.robot.moves))
        counted = harness.reflex.getStatistics().selfContacts
        assert bool(counted) == (not params)
    assert responses[0] == 0
    assert responses[1] > 0


def test_reflex_does_not_return_through_own_body(
    start_at: StartAt, caplog: pytest.LogCaptureFixture
) -> None:
    """The arm came around the body; the straight way to the start pose leads through it."""
    harness = start_at(
        (0.37, 0.6, 0.37, 0.6, 0.0),
        (-0.33, 0.6, 2.52, 1.35, -1.74),
        (-0.33, 0.32, 2.52, 1.35, -1.74),
    )
    harness.robot.press(harness.field("upper_arm_outer"), 0.004, 0.2)
    assert largest_own_force(harness, 4.0) == 0.0
    assert harness.robot.moves, "it was not felt"
    harness.run_until("Watching")
    assert "the arm stays: every way back would press it against the robot" in caplog.text


def test_close_points_are_on_both_limbs_of_a_flexed_arm() -> None:
    """An arm that touches itself is felt by the skin of the upper arm and of the lower arm."""
    body = BodyModel.load(description("nao_h25"), "left_arm")
    flexed = body.part.start.copy()
    flexed[3] = body.part.mapping.limits[1][3]
    places = body.close_points(flexed, 0.05)
    between_limbs = [place for place in places if place.other in {"LBicep", "l_wrist"}]
    assert {(place.limb, place.other) for place in between_limbs} == {
        ("upper_arm", "l_wrist"),
        ("lower_arm", "LBicep"),
    }
