"""MotorTest of icub-tests: targets are reached in time, and the end of the motion is told."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode


def test_motors_reach_their_targets_in_time(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 0.35)
    low, high = arm.board.limits.low, arm.board.limits.high
    for share in (0.5, 0.3, 0.7):
        goal = low + share * (high - low)
        time = np.abs(goal - arm.board.references.position).max() / 0.35
        arm.command.position_move(None, goal)
        assert not arm.command.motion_done().all()
        arm.world.advance(time + 0.1)
        assert arm.command.motion_done().all()
        assert arm.board.position == pytest.approx(goal, abs=0.02)
    arm.command.relative_move(None, -0.1)
    arm.world.advance(1.0)
    assert arm.board.position == pytest.approx(goal - 0.1, abs=0.02)


def test_motor_stop_ends_motion_in_place(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 0.3)
    arm.command.position_move(None, arm.inside)
    arm.world.advance(0.3)
    arm.command.stop()
    assert arm.command.motion_done().all()
    arm.world.advance(0.3)
    here = arm.board.state().position
    arm.world.advance(0.5)
    assert arm.board.state().position == pytest.approx(here, abs=0.002)
