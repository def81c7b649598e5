"""A finger presses on an arm in a random pose, in physics: the touched place moves away."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.models.body_model import BodyModel
from robocomp_dsl.simulation.robots.catalog import description
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.law import Field
from tests.touch.kinematic_robot import ReflexHarness
from tests.touch.physical_robot import FINGER, PhysicalRobot

PRESSES = 6
FREE = 0.03
"""Distance of the arm to the rest of the robot in the poses of the test [m]."""


def inward(robot: Any, field: Field) -> Floats:
    limb = robot.part.limb(field.limb)
    out = np.array([0.0, *field.centre[1:]])
    turn = robot.body.data.body(limb.body).xmat.reshape(3, 3)
    way: Floats = -turn @ limb.axes @ (out / np.linalg.norm(out))
    return way


def touches_skin(robot: Any, field: Field) -> bool:
    """Whether a finger before the centre of the field is next to the skin of its limb."""
    limb, data, model = robot.part.limb(field.limb), robot.body.data, robot.body.model
    way, geom = inward(robot, field), np.zeros(1, np.int32)
    start = robot.spot(field) - 0.04 * way
    mujoco.mj_ray(model, data, start, way, None, 1, -1, geom)
    hit = model.body(int(model.geom_bodyid[geom[0]])).name if geom[0] >= 0 else ""
    finger = robot.surface(field, -0.004, 0.0)
    near = np.linalg.norm(finger - robot.spot(field)) < 0.02 + FINGER
    return bool(near and hit in {limb.body, *limb.covers})


@pytest.mark.parametrize(
    ("robot", "side"), [("nao_h25", "left_arm"), ("nao_h25", "right_arm"), ("icub_v2", "left_arm")]
)
def test_reflex_withdraws_from_finger_in_random_poses(
    start_reflex: Callable[..., ReflexHarness], robot: str, side: str
) -> None:
    body = BodyModel.load(description(robot), side)
    low, high = body.part.mapping.limits
    rng, moved = np.random.default_rng(11), []
    harness = start_reflex(robot, side, PhysicalRobot, threshold=0.03, full=0.12, hold=1.0)
    harness.wait_until_watching()
    arm = harness.robot
    while len(moved) < PRESSES:
        pose = rng.uniform(low, high)
        if body.clearance(pose, FREE) < min(FREE, body.clearance(body.part.start, FREE)):
            continue
        harness.reflex.enable(False)
        arm.move(pose, arm.part.speed_limits * 0.3)
        harness.run(2.5)
        field = body.part.fields[int(rng.integers(len(body.part.fields)))]
        if np.abs(arm.poses[-1] - pose).max() < 0.05 and touches_skin(arm, field):
            harness.reflex.enable(True)
            arm.moves.clear()
            before, way = arm.spot(field), inward(arm, field)
            arm.press(field, 0.003, 0.2)
            harness.run(0.6)
            if arm.moves:
                moved.append(float(way @ (arm.spot(field) - before)))
        harness.reflex.enable(False)
        harness.run_until("Watching", 20.0)
    assert min(moved) > 0.0, moved
    assert np.median(moved) > 0.01
