"""The reflex freezes while arm or skin is silent or refuses; it is an emergency with a reason."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy, LifeState
from tests.touch.kinematic_robot import KinematicRobot, interfaces, with_fields

WRONG_LIMITS = {
    "4 joints": {name: np.zeros(4) for name in ("low", "high", "speed", "start")},
    "NaN": {"start": np.full(5, np.nan)},
    "differ in length": {"speed": np.ones(4)},
    "above its upper": {"low": np.full(5, 9.0)},
    "speed limit of 0": {"speed": np.zeros(5)},
}


@pytest.mark.parametrize(("message", "wrong"), WRONG_LIMITS.items(), ids=list(WRONG_LIMITS))
def test_reflex_stays_frozen_with_invalid_arm_limits(start_reflex, message, wrong) -> None:
    class RobotWithInvalidLimits(KinematicRobot):
        def limits(self) -> Any:
            return with_fields(super().limits(), **wrong)

    harness = start_reflex("nao_h25", "left_arm", RobotWithInvalidLimits)
    harness.run(1.0)
    assert harness.state == "Frozen"
    assert message in harness.worker().reason


@pytest.mark.parametrize("pose", [np.full(5, np.nan), np.zeros(4), np.zeros(0)])
def test_reflex_ignores_invalid_arm_state(harness, pose) -> None:
    publish = harness.robot.states_proxy.armState
    harness.robot.states_proxy.armState = lambda state: publish(with_fields(state, position=pose))
    harness.run(0.4)
    assert harness.state == "Watching"
    harness.run(0.2)
    assert harness.state == "Frozen"
    assert "no state of the arm received" in harness.worker().reason


@pytest.mark.parametrize("lost", ["publishes_skin", "publishes_state"])
def test_reflex_freezes_and_keeps_watching_while_peers_are_silent(harness, lost) -> None:
    setattr(harness.robot, lost, False)
    harness.run(0.6)
    assert harness.state == "Frozen"
    assert harness.robot.stops == 1
    setattr(harness.robot, lost, True)
    harness.run(0.4)
    assert harness.state == "Frozen"  # it must have been there for a while
    harness.run(0.3)
    assert harness.state == "Watching"
    assert harness.robot.moves == []  # the arm was where it belongs


@pytest.mark.parametrize(("lost", "state"), [(10, "Watching"), (11, "Watching"), (12, "Frozen")])
def test_reflex_freezes_only_after_second_look(harness, lost, state) -> None:
    """Eleven frames are more than 0.2 s; but one that was held up itself has them waiting."""
    harness.robot.publishes_skin = False
    harness.run(0.02 * lost)
    harness.robot.publishes_skin = True
    harness.run(0.02)
    assert harness.state == state


@pytest.mark.parametrize("lost", ["publishes_skin", "publishes_state"])
def test_reflex_stops_moving_arm_and_returns_later(harness, lost) -> None:
    harness.press("lower_arm_outer", 20.0)
    harness.run(0.06)
    harness.release()
    assert harness.state == "Withdrawing"
    setattr(harness.robot, lost, False)
    harness.run_until("Frozen", 0.6)
    there, moves = harness.robot.pose, len(harness.robot.moves)
    assert harness.robot.stops == 1
    harness.press("lower_arm_outer", 20.0)
    harness.run(1.0)
    assert len(harness.robot.moves) == moves
    assert (harness.robot.pose == there).all()
    harness.release()
    setattr(harness.robot, lost, True)
    harness.run_until("Returning", 1.0)
    harness.run_until("Watching")
    assert harness.robot.pose == pytest.approx(harness.robot.part.start, abs=0.03)


def test_reflex_freezes_when_arm_refuses_and_stops_it_later(harness) -> None:
    harness.robot.answers = False
    harness.press("lower_arm_under", 20.0)
    harness.run(0.1)
    assert harness.state == "Frozen"
    assert "the arm does not move" in harness.worker().reason or "cable" in harness.worker().reason
    assert harness.robot.stops == 0
    harness.release()
    harness.run(2.0)
    assert harness.state == "Frozen"
    assert "the cable is out" in harness.worker().reason
    harness.robot.answers = True
    harness.run(0.2)
    assert harness.robot.stops == 1
    assert harness.state == "Frozen"
    harness.run_until("Watching")
    assert harness.robot.stops == 1


def test_reflex_freezes_again_when_arm_cannot_return(harness) -> None:
    harness.press("lower_arm_under", 20.0)
    harness.run(0.04)
    harness.release()
    harness.run_until("Holding")
    harness.robot.answers = False
    harness.run(1.0)
    assert harness.state == "Frozen"
    harness.robot.answers = True
    harness.run_until("Watching")


def test_reflex_emergency_is_visible_with_reason(harness) -> None:
    about = harness.proxy(ComponentProxy, "reflex", "Component")
    assert COMPONENT is ComponentProxy.INTERFACE
    assert about.getInfo().state == LifeState.Compute
    harness.robot.publishes_state = False
    harness.run(0.7)
    info = about.getInfo()
    assert info.state == LifeState.Emergency
    assert info.reason == "no state of the arm received for 0.5 s"
    assert info.states == ["Frozen"]
    assert harness.reflex.getStatistics().state == interfaces.ReflexState.Frozen
    assert harness.robot.reflex_messages[-1] == interfaces.ReflexState.Frozen
    harness.robot.publishes_state, harness.robot.publishes_skin = True, False
    harness.run(0.3)
    assert about.getInfo().reason == "no valid frame of the skin received for 0.2 s"
    harness.robot.publishes_skin = True
    harness.run_until("Watching")
    assert about.getInfo().reason == ""


def test_reflex_treats_restarted_time_as_interruption(harness) -> None:
    harness.press("lower_arm_under", 20.0)
    harness.run(0.04)
    harness.release()
    harness.run(1.0)
    harness.robot.clock.reset()
    harness.run_until("Frozen", 1.0)
    harness.run_until("Watching", 5.0)
    harness.press("lower_arm_under", 20.0)
    harness.run(0.04)
    assert harness.state == "Withdrawing"
    assert harness.reflex.getStatistics().withdrawals == 2
