"""The component `generic_arm` on the boards of two robots: the same words, the same arm."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from arm_client import ARM, DESCRIPTIONS, RunningArm, until, wires_of
from served_robot import ServedRobot

ROBOTS = ("nao_h25", "icub_v2")


@pytest.fixture(params=ROBOTS)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def robot(name: str, request: pytest.FixtureRequest) -> Iterator[ServedRobot]:
    made = ServedRobot(name, ARM.interfaces, request.node.nodeid)
    yield made
    made.away()


@pytest.fixture
def arm(name: str, robot: ServedRobot, request: pytest.FixtureRequest) -> Iterator[RunningArm]:
    made = RunningArm(
        request.node.nodeid, wires_of(robot, name), f"description={DESCRIPTIONS / name}.yaml"
    )
    until(lambda: made.states)
    yield made
    assert made.end()


def test_it_tells_where_the_arm_is(arm: RunningArm, robot: ServedRobot) -> None:
    """The robots stand in the start pose of their descriptions."""
    assert arm.getState().position == pytest.approx(arm.getLimits().start, abs=0.05)


def test_the_same_command_gives_the_same_angles(arm: RunningArm) -> None:
    goal = np.array([0.5, 0.6, 0.3, 0.9, 0.2])
    outcome = arm.move(goal, np.full(5, 1.5))
    assert not outcome.clipped.any()
    assert not outcome.dropped.any()
    assert arm.getState().moving
    arm.came_to_rest()
    assert arm.getState().position == pytest.approx(goal, abs=0.03)
