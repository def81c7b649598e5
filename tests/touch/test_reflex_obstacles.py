"""Obstacles that stay in the way of the return, and touches that the arm cannot leave."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from tests.touch.kinematic_robot import CentredRobot, ReflexHarness, interfaces
from tests.touch.physical_robot import PhysicalRobot

FORCES = {"threshold": 0.03, "full": 0.12}


def limitations(harness: ReflexHarness) -> list[interfaces.Limitation]:
    messages = harness.robot.reflex_messages
    return [message for message in messages if isinstance(message, interfaces.Limitation)]


def withdrawals(harness: ReflexHarness, seconds: float) -> int:
    """How often the arm withdraws from a finger that stays where the arm was."""
    harness.wait_until_watching()
    harness.robot.press(harness.field("lower_arm_outer"), 0.004, seconds + 1.0)
    harness.run(seconds)
    return int(harness.reflex.getStatistics().withdrawals)


@pytest.mark.parametrize("robot", ["nao_h25", "icub_v2"])
def test_reflex_returns_more_rarely_while_obstacle_stays(start_reflex, robot, caplog) -> None:
    """Before, it knocked about 15 times in 20 s."""
    caplog.set_level(logging.WARNING)
    harness = start_reflex(robot, "left_arm", PhysicalRobot, **FORCES)
    knocks = withdrawals(harness, 20.0)
    assert 3 <= knocks <= 6
    pauses = [event.pause for event in limitations(harness) if event.cause.name == "Obstacle"]
    assert pauses == [2.0**n * 0.5 for n in range(1, len(pauses) + 1)]
    assert "an obstacle stays at `lower_arm_" in caplog.text


def test_reflex_returns_often_without_longer_pauses(start_reflex) -> None:
    """The test above can fail."""
    harness = start_reflex("nao_h25", "left_arm", PhysicalRobot, **FORCES, longest_pause=0.0)
    assert withdrawals(harness, 20.0) > 8


def test_reflex_returns_soon_again_after_obstacle_has_gone(start_reflex) -> None:
    harness = start_reflex(
        "nao_h25", "left_arm", CentredRobot, refractory=0.0
    ).wait_until_watching()
    for state in ("Watching", "Returning", "Returning"):
        harness.run_until(state)
        harness.run(0.1)
        harness.press("lower_arm_under", 5.0)
        harness.run(0.04)
        harness.release()
    assert harness.worker().obstacle.attempts == 2
    harness.run_until("Watching", 20.0)
    harness.run(3.0)
    harness.press("lower_arm_under", 5.0)
    harness.run(0.04)
    harness.release()
    harness.run_until("Holding")
    harness.run(0.6)
    assert harness.state == "Returning"
    assert harness.worker().obstacle.attempts == 0


@pytest.mark.parametrize("law", ["pose", "fixed"])
def test_reflex_reports_joints_at_limits_and_uses_others(start_reflex, law, caplog) -> None:
    class CorneredRobot(CentredRobot):
        """Its arm rests where the joints of the field `lower_arm_under` cannot move further."""

        def initialize(self) -> None:
            super().initialize()
            field = next(f for f in self.part.fields if f.name == "lower_arm_under")
            limit = np.where(field.motion > 0.0, self.arm.high, self.arm.low)
            self.moving = field.motion != 0.0
            pose = np.where(self.moving, limit, self.part.start)
            self.rest = self.pose = self.goal = pose

    harness = start_reflex("nao_h25", "left_arm", CorneredRobot, law=law).wait_until_watching()
    harness.press("lower_arm_under", 5.0)
    harness.run(0.04)
    moved = harness.robot.moves[0][1] - harness.robot.rest
    assert np.abs(moved[~harness.robot.moving]).max() > 0.05
    if law == "fixed":
        (limitation,) = limitations(harness)
        assert (limitation.cause.name, limitation.field) == ("JointLimits", "lower_arm_under")
        assert "joints that would move away are at their limits" in caplog.text
