"""What one step of a control board of 30 joints costs, in each kind of mode, in CPU time.

The joints follow their references exactly, as they do on a robot that works. Besides, what one step
of a Cartesian controller costs. How long a command needs to a motor is in `bench_simulator`.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.kinematics.cartesian import goal_of, step
from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.devices.control_board_chain import extract_chain
from robocomp_dsl.simulation.robots.boards import robot_board
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.world.world import World

JOINTS = 30
ROUNDS, STEPS = 60, 50
GOAL = 50.0


def _board() -> tuple[Board, Commands]:
    joints = tuple(JointSpec(f"j{i}", -2.0, 2.0, 4.0, 5.0) for i in range(JOINTS))
    board = Board(BoardSpec(joints, tuple(MotorSpec(f"m{i}") for i in range(JOINTS))))
    return board, Commands(board)


def _hold(command: Commands) -> None:
    command.set_mode(None, Mode.POSITION)


def _move(command: Commands) -> None:
    command.set_mode(None, Mode.POSITION)
    command.position_move(None, 1.5)


def _drive(command: Commands) -> None:
    command.set_mode(None, Mode.VELOCITY)
    command.velocity_move(None, 0.05)


def _comply(command: Commands) -> None:
    command.set_mode(None, Mode.POSITION)
    command.set_interaction(None, Interaction.COMPLIANT)


def _mixture(command: Commands) -> None:
    modes = (Mode.POSITION, Mode.VELOCITY, Mode.TORQUE, Mode.PWM, Mode.CURRENT, Mode.MIXED)
    command.set_mode(None, [modes[i % len(modes)] for i in range(JOINTS)])


CASES: dict[str, Callable[[Commands], None]] = {
    "hold": _hold,
    "move": _move,
    "velocity": _drive,
    "compliant": _comply,
    "all modes": _mixture,
}


def _cartesian() -> list[dict[str, Any]]:
    """A step comes 100 times a second; it may cost a tenth of that time."""
    robot = ROBOTS["icub_v2"]()
    spec = new_world(0.001)
    add_robot(spec, robot)
    part = SimulatedBoard(robot_board(robot, "right_arm"))
    chain = extract_chain(World(spec, [part]).model, part.board.spec.names, "r_hand")
    goal, best = goal_of(chain.pose(chain.rest * 0.9)), np.inf
    for _ in range(ROUNDS):
        start = time.thread_time()
        step(chain, chain.rest, goal.error(chain.pose(chain.rest)), chain.rest * 0.0, 1e-4)
        best = min(best, time.thread_time() - start)
    name = "step of a Cartesian controller of 7 joints"
    return [{"name": name, "value": best * 1e6, "unit": "us", "goal": 1000.0}]


def run() -> list[dict[str, Any]]:
    """All rows."""
    return [*_steps(), *_cartesian()]


def _steps() -> list[dict[str, Any]]:
    """The best of many short rounds, in us a step; cases take turns."""
    boards = {}
    weight = np.full(JOINTS, 0.1)
    for name, begin in CASES.items():
        board, command = _board()
        board.begin(np.zeros(JOINTS), np.zeros(JOINTS))
        begin(command)
        boards[name] = board
    best = dict.fromkeys(CASES, np.inf)
    for _ in range(ROUNDS):
        for name, board in boards.items():
            start = time.thread_time()
            for _ in range(STEPS):
                board.step(board.references.position, board.references.velocity, 0.001, weight)
            best[name] = min(best[name], (time.thread_time() - start) / STEPS)
    return [
        {
            "name": f"control step of {JOINTS} joints, {name}",
            "value": value * 1e6,
            "unit": "us",
            "goal": GOAL,
        }
        for name, value in best.items()
    ]
