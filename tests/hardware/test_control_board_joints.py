"""Faults, coupled joints and whole robots of control boards."""

from __future__ import annotations

import numpy as np
import pytest

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import (
    ModeRefused,
)
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.protection.faults import FaultCode
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.robots.boards import board_names, robot_board, whole_robot
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.world.world import World
from tests.hardware.plain_board import plain_board


def test_control_board_encoder_without_number_is_fault_of_its_joint():
    board, command = plain_board()
    command.set_mode(None, Mode.POSITION)
    board.step(np.full(3, 0.1), np.zeros(3), 0.001)
    torque = board.step(np.array([0.1, np.nan, 0.2]), np.zeros(3), 0.001)
    assert board.table.modes == [Mode.POSITION, Mode.HW_FAULT, Mode.POSITION]
    assert board.faults.last[1].code is FaultCode.ENCODER
    assert np.isfinite(torque).all()
    assert torque[1] == 0.0
    assert board.position == pytest.approx([0.1, 0.1, 0.2])


def test_control_board_heat_and_lateness_are_faults():
    board, command = plain_board()
    command.set_mode(None, [Mode.POSITION, Mode.POSITION, Mode.IDLE])
    board.step(np.zeros(3), np.zeros(3), 0.001)
    board.motors.set_temperature(np.array([100.0, 25.0, 25.0]))
    board.pid.set_error_limits(np.arange(3), np.full(3, 0.2))
    board.step(np.array([0.0, 0.3, 0.3]), np.zeros(3), 0.001)
    assert [fault.code for fault in board.faults.last] == [
        FaultCode.OVERTEMPERATURE,
        FaultCode.TRACKING,
        FaultCode.NONE,
    ]


def test_control_board_coupled_joints_change_mode_together():
    icub = robot_board(ROBOTS["icub_v2"](), "right_arm")
    board = Board(icub.spec)
    command = Commands(board)
    command.set_mode(["r_shoulder_roll"], Mode.POSITION)
    assert board.table.modes == [Mode.POSITION] * 3 + [Mode.IDLE] * 4
    with pytest.raises(ModeRefused, match="coupled"):
        command.set_mode([0, 1], [Mode.VELOCITY, Mode.TORQUE])
    assert board.table.modes[0] is Mode.POSITION
    board.fault(np.array([2]), FaultCode.EXTERNAL, "pulled the plug")
    assert board.table.modes == [Mode.HW_FAULT] * 3 + [Mode.IDLE] * 4


def test_control_board_may_contain_whole_robot():
    for name in ROBOTS:
        robot = ROBOTS[name]()
        whole = whole_robot(robot)
        assert len(whole.spec.joints) == len(robot.motors)
        parts = [robot_board(robot, part) for part in board_names(robot)]
        assert whole.spec.names == tuple(n for part in parts for n in part.spec.names)
    with pytest.raises(KeyError):
        robot_board(robot, "tail")


def test_control_board_eyes_turn_by_version_and_vergence():
    robot = ROBOTS["icub_v2"]()
    spec = new_world()
    add_robot(spec, robot)
    head = SimulatedBoard(robot_board(robot, "head"))
    world = World(spec, [head])
    head.commands.set_mode(None, Mode.POSITION)
    head.settings.set_reference_speed(None, 1.0)
    head.commands.position_move(["eyes_version", "eyes_vergence"], [0.2, 0.3])
    world.advance(1.5)
    left, right = (world.data.joint(f"{side}_eye_pan").qpos[0] for side in "lr")
    assert (left, right) == pytest.approx((0.35, 0.05), abs=0.01)


def test_control_board_refuses_world_without_its_joints():
    robot = ROBOTS["nao_h21"]()
    spec = new_world()
    add_robot(spec, robot, prefix="a_")
    World(spec, [SimulatedBoard(robot_board(robot, "LArm"), prefix="a_")])
    spec = new_world()
    with pytest.raises(SceneError, match="no joint `LShoulderPitch`"):
        World(spec, [SimulatedBoard(robot_board(robot, "LArm"))])
