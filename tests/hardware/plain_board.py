"""A control board without a simulation."""

from __future__ import annotations

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec


def plain_board(n: int = 3, **joint) -> tuple[Board, Commands]:
    """A board of `n` joints and motors, and its commands."""
    joints = tuple(JointSpec(f"j{i}", -1.0, 1.0, 2.0, 5.0, **joint) for i in range(n))
    board = Board(BoardSpec(joints, tuple(MotorSpec(f"m{i}") for i in range(n))))
    return board, Commands(board)
