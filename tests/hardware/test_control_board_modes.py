"""Control modes, commands and refusals of a control board."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import (
    BadValue,
    NoSpeed,
    NotEquipped,
    UnknownJoint,
    WrongMode,
)
from robocomp_dsl.hardware.control.modes import SELECTABLE, Interaction, Mode
from robocomp_dsl.hardware.control.settings import ControlSettings
from tests.hardware.plain_board import plain_board


def test_control_board_reaches_and_holds_velocity_by_acceleration(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(None, Mode.VELOCITY)
    arm.settings.set_acceleration(None, 0.5)
    arm.command.velocity_move(None, 0.2)
    arm.world.advance(0.2)
    assert arm.board.references.velocity == pytest.approx(np.full(len(arm.inside), 0.1), abs=0.01)
    arm.world.advance(0.5)
    assert arm.board.velocity == pytest.approx(np.full(len(arm.inside), 0.2), abs=0.03)
    arm.command.velocity_move(None, 0.2, hold=0.1)
    arm.world.advance(1.0)
    assert arm.board.velocity == pytest.approx(np.zeros(len(arm.inside)), abs=0.01)
    fast = arm.command.velocity_move(None, 100.0)
    assert fast.all()
    assert (arm.board.references.ramp.target == arm.board.limits.speed).all()
    arm.command.stop()


def test_control_board_sets_direct_velocity_at_once(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    arm.command.set_mode(None, Mode.VELOCITY_DIRECT)
    arm.command.set_velocity(None, 0.2)
    arm.world.advance(0.002)
    assert arm.board.references.velocity == pytest.approx(np.full(len(arm.inside), 0.2))
    arm.world.advance(0.5)
    assert arm.board.velocity == pytest.approx(np.full(len(arm.inside), 0.2), abs=0.02)
    arm.command.set_velocity(None, 0.0)
    arm.world.advance(0.3)
    assert arm.board.velocity == pytest.approx(np.zeros(len(arm.inside)), abs=0.01)


def test_control_board_mixed_mode_adds_velocity_to_motion(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    start = arm.inside - 0.15
    arm.go(None, start)
    arm.command.set_mode(None, Mode.MIXED)
    arm.settings.set_reference_speed(None, 0.1)
    arm.command.position_move(None, start + 0.1)
    arm.command.velocity_move(None, 0.05, hold=1.0)
    arm.world.advance(2.0)
    assert arm.board.position == pytest.approx(start + 0.15, abs=0.02)


def test_control_board_compliant_arm_yields_and_returns(arm):
    joint = 3
    arm.command.set_mode(None, Mode.POSITION)
    arm.settings.set_reference_speed(None, 1.0)
    arm.go(None, arm.inside)
    torque, dof = 0.1 * arm.spec.joints[joint].torque_limit, arm.part._speed[joint]

    def pushed(stiffness: float | None) -> float:
        if stiffness:
            arm.command.set_interaction([joint], Interaction.COMPLIANT)
            arm.settings.set_impedance([joint], stiffness, 0.1 * stiffness)
        before = arm.board.position[joint]
        arm.world.data.qfrc_applied[dof] = torque
        arm.world.advance(3.0)
        moved = arm.board.position[joint] - before
        arm.world.data.qfrc_applied[dof] = 0.0
        arm.world.advance(3.0)
        assert arm.board.position[joint] == pytest.approx(arm.inside[joint], abs=0.02)
        return float(moved)

    soft = 4.0 * torque
    assert abs(pushed(None)) < 0.01
    assert pushed(soft) == pytest.approx(0.25, abs=0.03)
    assert pushed(2 * soft) == pytest.approx(0.125, abs=0.02)
    arm.settings.set_impedance_offset([joint], -0.1 * torque)
    arm.world.advance(2.0)
    assert arm.board.position[joint] - arm.inside[joint] == pytest.approx(-0.0125, abs=0.005)


WRONG_COMMANDS = {
    "position_move": (Mode.POSITION, Mode.MIXED),
    "relative_move": (Mode.POSITION, Mode.MIXED),
    "set_position": (Mode.POSITION_DIRECT,),
    "velocity_move": (Mode.VELOCITY, Mode.MIXED),
    "set_velocity": (Mode.VELOCITY_DIRECT,),
    "set_torque": (Mode.TORQUE,),
    "set_duty": (Mode.PWM,),
    "set_current": (Mode.CURRENT,),
}


@pytest.mark.parametrize("mode", [m for m in SELECTABLE if m is not Mode.FORCE_IDLE])
@pytest.mark.parametrize("name", WRONG_COMMANDS)
def test_control_board_refuses_command_of_another_mode(name, mode):
    _, command = plain_board()
    command.set_mode(None, mode)
    if mode in WRONG_COMMANDS[name]:
        getattr(command, name)(None, 0.1)
    else:
        with pytest.raises(WrongMode, match=f"is in mode `{mode}`; `{name}` needs"):
            getattr(command, name)(None, 0.1)


@pytest.mark.parametrize(
    ("joints", "values", "error"),
    [
        (None, np.nan, BadValue),
        (None, [0.0, np.inf, 0.0], BadValue),
        (None, [0.0], BadValue),
        (["j9"], 0.0, UnknownJoint),
        ([3], 0.0, UnknownJoint),
        (["j0", "j0"], 0.0, UnknownJoint),
        (None, "fast", BadValue),
    ],
)
@pytest.mark.parametrize("name", WRONG_COMMANDS)
def test_control_board_refuses_invalid_commands_unchanged(name, joints, values, error):
    board, command = plain_board()
    command.set_mode(None, WRONG_COMMANDS[name][0])
    board.step(np.zeros(3), np.zeros(3), 0.001)
    with pytest.raises(error):
        getattr(command, name)(joints, values)
    assert not board.step(np.zeros(3), np.zeros(3), 0.001).any()


def test_control_board_refuses_other_invalid_requests():
    board, command = plain_board(torque_control=False)
    with pytest.raises(NotEquipped):
        command.set_interaction(None, Interaction.COMPLIANT)
    command.set_mode(None, Mode.POSITION)
    ControlSettings(board).set_reference_speed([1], 0.0)
    with pytest.raises(NoSpeed, match="`j1`"):
        command.position_move(None, 0.5)
    command.set_mode(None, Mode.TORQUE)
    with pytest.raises(NotEquipped):
        command.set_torque(None, 1.0)
    with pytest.raises(BadValue):
        command.set_mode([0, 1], [Mode.IDLE])
    command.set_mode(None, [Mode.IDLE, Mode.POSITION, Mode.VELOCITY])
    assert board.table.modes == [Mode.IDLE, Mode.POSITION, Mode.VELOCITY]
