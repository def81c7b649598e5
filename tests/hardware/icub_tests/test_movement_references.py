"""movementReferencesTest and torqueControl-consistency: references are read as written."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.targets import targets

WRITTEN = {
    "position": (Mode.POSITION, "position_move", 0.1),
    "velocity": (Mode.VELOCITY, "velocity_move", 0.05),
    "torque": (Mode.TORQUE, "set_torque", 0.02),
    "duty": (Mode.PWM, "set_duty", 1.5),
    "current": (Mode.CURRENT, "set_current", 0.01),
}
"""Reference: the mode that takes it, the command that writes it, a value that no limit clips."""


def share(arm, name: str, value: float) -> np.ndarray:
    """A different value for each joint; positions lie about the middle of the ranges."""
    steps = value * np.linspace(0.5, 1.0, len(arm.spec.joints))
    return arm.inside + steps if name == "position" else steps


@pytest.mark.parametrize("name", WRITTEN)
def test_movement_references_are_read_back_as_written(arm, name):
    mode, command, value = WRITTEN[name]
    arm.command.set_mode(None, mode)
    arm.world.advance(0.01)
    everyone = share(arm, name, value)
    assert not getattr(arm.command, command)(None, everyone).any()
    assert getattr(targets(arm.board), name) == pytest.approx(everyone)
    joint = arm.spec.names[3]  # a single one, by name: the others stay
    getattr(arm.command, command)([joint], everyone[3] * 0.9)
    everyone[3] *= 0.9
    assert getattr(targets(arm.board), name) == pytest.approx(everyone)
    group = [4, 0]  # a group, in any order
    getattr(arm.command, command)(group, everyone[group] * 0.8)
    everyone[group] *= 0.8
    arm.world.advance(0.01)
    assert getattr(targets(arm.board), name) == pytest.approx(everyone)
    assert getattr(targets(arm.board, group), name) == pytest.approx(everyone[group])


@pytest.mark.parametrize("name", WRITTEN)
def test_movement_references_beyond_limits_are_read_back_clipped(arm, name):
    mode, command, _ = WRITTEN[name]
    arm.command.set_mode(None, mode)
    assert getattr(arm.command, command)(None, 1e6).all()
    limits, motors = arm.board.limits, arm.board.motors
    most = {
        "position": limits.high,
        "velocity": limits.speed,
        "torque": limits.torque,
        "duty": np.full(len(limits.low), 100.0),
        "current": motors.max_current,
    }
    assert getattr(targets(arm.board), name) == pytest.approx(most[name])


def test_movement_references_restart_on_mode_change(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.command.position_move(None, arm.inside)
    arm.world.advance(0.1)
    arm.command.set_mode(None, Mode.VELOCITY)
    assert targets(arm.board).position == pytest.approx(arm.board.position)
    assert not targets(arm.board).velocity.any()
    arm.command.velocity_move(None, 0.05)
    arm.command.set_mode(None, Mode.IDLE)
    now = targets(arm.board)
    assert not any((now.velocity.any(), now.torque.any(), now.duty.any(), now.current.any()))
