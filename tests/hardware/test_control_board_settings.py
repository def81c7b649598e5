"""Settings and remote variables of a control board."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.errors import (
    BadValue,
    ControlRefused,
)
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.control.regulators.pid import Gains
from robocomp_dsl.hardware.control.settings import ControlSettings
from robocomp_dsl.hardware.control.variables import RemoteVariables
from tests.hardware.plain_board import plain_board


def test_control_board_checks_settings_without_motion(arm):
    arm.command.set_mode(None, Mode.POSITION)
    arm.world.advance(0.2)
    first = arm.spec.names[0]
    arm.settings.set_pid(first, Gains(kp=1.0))
    assert arm.settings.pid(0).kp == 1.0
    here = arm.board.position.copy()
    arm.settings.set_encoder([first], here[0] + 0.1)
    arm.settings.set_motor_encoder([first], 7)
    assert arm.board.state().motor_counts[0] == 7
    arm.world.advance(0.2)
    moved = arm.world.data.joint(first).qpos[0] - here[0]
    assert abs(moved) < 0.02
    assert arm.board.position[0] == pytest.approx(here[0] + 0.1, abs=0.02)
    low, high = arm.settings.position_limits()
    arm.settings.set_position_limits([1], low[1] + 0.1, high[1] - 0.1)
    assert arm.settings.position_limits([1])[0] == pytest.approx(low[1] + 0.1)
    assert arm.settings.last_fault(first).code is FaultCode.NONE
    arm.settings.set_speed_limits(None, 1.0)
    for wrong in (
        lambda: arm.settings.set_position_limits([1], low[1] - 1.0, high[1]),
        lambda: arm.settings.set_encoder([0], np.nan),
        lambda: arm.settings.set_speed_limits(None, 0.0),
        lambda: arm.settings.set_impedance([0], 1e9, 0.0),
        lambda: arm.settings.pid("nobody"),
    ):
        with pytest.raises(ControlRefused):
            wrong()


def test_control_board_reads_back_settings_and_switches_regulators():
    board, command = plain_board()
    settings = ControlSettings(board)
    command.set_mode(None, Mode.POSITION)
    settings.set_reference_speed(["j1"], 0.7)
    settings.set_acceleration([2], 3.0)
    settings.set_impedance(["j0"], 2.0, 0.5)
    settings.set_impedance_offset(["j0"], 0.1)
    assert settings.reference_speed(["j1"]).tolist() == [0.7]
    assert settings.acceleration().tolist() == [10.0, 10.0, 3.0]
    assert settings.impedance("j0") == (2.0, 0.5, 0.1)
    board.step(np.zeros(3), np.zeros(3), 0.001)
    off = np.full(3, -0.02)
    assert (board.step(off, np.zeros(3), 0.001) > 0.5).all()
    settings.enable_pid(["j1"], on=False)
    torque = board.step(off, np.zeros(3), 0.001)
    assert torque[1] == 0.0
    assert torque[0] > 0.5
    for _ in range(100):
        board.step(off, np.zeros(3), 0.01)
    summed = board.pid.integral.copy()
    settings.reset_pid([0])
    assert board.pid.integral.tolist() == [0.0, 0.0, summed[2]]
    assert summed[2] > 0.0
    settings.set_max_current(None, 0.0)
    board.step(off, np.zeros(3), 0.001)
    assert board.table.modes == [Mode.HW_FAULT] * 3
    with pytest.raises(BadValue):
        settings.set_max_current([0], -1.0)


def test_control_board_remote_variables_are_read_and_written():
    board, _ = plain_board()
    variables = RemoteVariables(board)
    assert "pid.j1" in variables.keys()  # noqa: SIM118 - not a dictionary
    variables.set("pid.j1", [1, 2, 3, 0])
    assert board.pid.gains[1].kp == 1.0
    assert variables.get("pid.j1").tolist() == [1, 2, 3, 0]
    variables.set("speed_limits", 0.5)
    assert board.limits.speed.tolist() == [0.5] * 3
    for key, values in (
        ("pid.j9", [1, 2, 3, 0]),
        ("pid.j1", [1, 2]),
        ("pid.j1", [-1, 0, 0, 0]),
        ("gears", [1, 1, 1]),
        ("max_currents", [-1, 0, 0]),
        ("tracking_limits", 0.0),
    ):
        with pytest.raises(ControlRefused):
            variables.set(key, values)
    with pytest.raises(BadValue, match="there is no variable"):
        variables.get("x")
