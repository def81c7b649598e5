"""PositionDirect of icub-tests: joints follow a stream of positions."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.hardware.control.modes import Mode


def test_position_direct_follows_stream(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(None, Mode.POSITION_DIRECT)
    arm.world.advance(0.1)
    worst, wave = 0.0, 0.15
    for k in range(600):  # a sine at 0.4 Hz, commanded at 100 Hz
        goal = arm.inside + wave * np.sin(2 * np.pi * 0.4 * 0.01 * k)
        arm.command.set_position(None, goal)
        arm.world.advance(0.01)
        worst = max(worst, float(np.abs(arm.board.position - goal).max()))
    assert worst < 0.03


def test_position_direct_moves_single_joints_and_groups_only(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(None, Mode.POSITION_DIRECT)
    for group in ([3], [4, 0]):
        arm.world.advance(0.5)
        for k in range(101):
            arm.command.set_position(group, arm.inside[group] + 0.1 * np.sin(np.pi * k / 50))
            arm.world.advance(0.01)
            off = np.abs(arm.board.position - arm.inside)
            off[group] = 0.0
            assert off.max() < 0.02
            if k == 25:
                reached = arm.board.position[group] - arm.inside[group]
                assert (np.abs(reached - 0.1) < 0.03).all()
