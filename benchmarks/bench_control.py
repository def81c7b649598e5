"""What one step of a control board of 30 joints costs, in each kind of mode, in CPU time.

The joints follow their references exactly, as they do on a robot that works. Besides, how long a
command needs to the motors of a simulated arm whose physics runs at 1 kHz in a thread of its own,
and what one step of its Cartesian controller costs.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from robocomp_dsl.hardware.cartesian import goal_of, step
from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.modes import Interaction, Mode
from robocomp_dsl.hardware.mujoco.control_board import SimulatedBoard
from robocomp_dsl.hardware.mujoco.control_board_chain import chain_of
from robocomp_dsl.hardware.mujoco.world import World
from robocomp_dsl.hardware.robots.boards import robot_board
from robocomp_dsl.hardware.robots.build import add_robot, new_world
from robocomp_dsl.hardware.robots.catalog import ROBOTS
from robocomp_dsl.hardware.turns import Turns

JOINTS = 30
ROUNDS, STEPS = 60, 50
GOAL = 50.0
COMMANDS = 600


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


class _Arm:
    """An arm of an iCub in the air; its physics goes on at 1 kHz by the wall clock."""

    def __init__(self) -> None:
        robot = ROBOTS["icub_v2"]()
        spec = new_world(0.001)
        add_robot(spec, robot)
        self.part = SimulatedBoard(robot_board(robot, "right_arm"))
        self.world = World(spec, [self.part])
        self.world.model.opt.gravity[:] = 0  # a joint that fell to its limit would be held there
        self.turn, self.over = Turns(), threading.Event()
        self.driven = threading.Condition()
        self.torque = 0.0

    def live(self) -> None:
        """Step by step until it is over; a step that comes late is not made up for."""
        due = time.perf_counter()
        while not self.over.is_set():
            with self.turn:
                self.world.advance(0.001)
                torque = float(self.world.data.ctrl[self.part._motor[6]])
            with self.driven:
                self.torque = torque
                self.driven.notify_all()
            due = max(due + 0.001, time.perf_counter() - 0.001)
            time.sleep(max(0.0, due - time.perf_counter()))

    def latency(self, torque: float) -> float:
        """Seconds from a command to the step in which the motor gets it."""
        start = time.perf_counter()
        with self.turn:
            self.part.commands.set_torque([6], torque)
        with self.driven:
            self.driven.wait_for(lambda: abs(self.torque - torque) < 1e-9)
        return time.perf_counter() - start


def _latencies() -> list[dict[str, Any]]:
    arm = _Arm()
    arm.part.commands.set_mode([6], Mode.TORQUE)
    thread = threading.Thread(target=arm.live)
    thread.start()
    random = np.random.default_rng(1)
    taken = []
    try:
        for k in range(COMMANDS):
            time.sleep(0.001 + 0.002 * random.random())  # at any moment between two steps
            taken.append(arm.latency(0.001 * (1 - 2 * (k % 2))))
    finally:
        arm.over.set()
        thread.join()
    rows = (("median", 50, None), ("p99", 99, 2.0))
    late = {
        "name": "the machine's own lateness: a sleep of 1 ms, p99",
        "value": _lateness(),
        "unit": "ms",
    }
    return [
        late,
        *(
            {
                "name": f"command to motor of a simulated arm at 1 kHz, {name}",
                "value": float(np.percentile(taken, share)) * 1e3,
                "unit": "ms",
                "goal": goal,
            }
            for name, share, goal in rows
        ),
    ]


def _lateness() -> float:
    """How late threads wake up here, whatever they do; other work on the machine adds to it."""
    late = []
    for _ in range(COMMANDS):
        start = time.perf_counter()
        time.sleep(0.001)
        late.append(time.perf_counter() - start - 0.001)
    return float(np.percentile(late, 99)) * 1e3


def _cartesian() -> list[dict[str, Any]]:
    """A step comes 100 times a second; it may cost a tenth of that time."""
    arm = _Arm()
    chain = chain_of(arm.world.model, arm.part.board.spec.names, "r_hand")
    goal, best = goal_of(chain.pose(chain.rest * 0.9)), np.inf
    for _ in range(ROUNDS):
        start = time.thread_time()
        step(chain, chain.rest, goal.error(chain.pose(chain.rest)), chain.rest * 0.0, 1e-4)
        best = min(best, time.thread_time() - start)
    name = "step of a Cartesian controller of 7 joints"
    return [{"name": name, "value": best * 1e6, "unit": "us", "goal": 1000.0}]


def run() -> list[dict[str, Any]]:
    """All rows."""
    return [*_steps(), *_cartesian(), *_latencies()]


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
