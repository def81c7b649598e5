"""The last accepted references of a board.

In: joints. Out: numbers (n,), after clipping to the limits; a mode change resets them.
"""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Joints
from robocomp_dsl.hardware.control.joints import Floats


@dataclass(frozen=True, eq=False, slots=True)
class Targets:
    """All arrays in the order of the request: rad, rad/s, N m, percent, A.

    `position` is the goal of a motion, or the last direct position; `velocity` the goal of the
    ramp; the other fields belong to the modes of their names.
    """

    position: Floats
    velocity: Floats
    torque: Floats
    duty: Floats
    current: Floats


def targets(board: Board, joints: Joints = None) -> Targets:
    """The references of `joints`, all for None. Raises `UnknownJoint`."""
    chosen = board.select.indices(joints)
    references, law = board.references, board.law
    return Targets(
        references.trajectory.goal[chosen],
        references.ramp.target[chosen],
        law.torque[chosen],
        law.duty[chosen],
        law.current[chosen],
    )
