"""A device on top of a control board: it takes a hand to poses, on straight lines where it can.

In: goals in mm, told in the base of the chain. Out: direct positions for the joints, at `RATE`. A
goal is solved before anything moves; on the way, damped least squares follows a line of minimum
jerk, and joint angles of the solution draw the rest of the arm along.
"""

from __future__ import annotations

import math
from enum import Enum

import numpy as np

from robocomp_dsl.hardware.cartesian import (
    Chain,
    Goal,
    Solution,
    goal_of,
    rotation_vector,
    solve,
    step,
)
from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import WrongMode
from robocomp_dsl.hardware.control.joints import Floats
from robocomp_dsl.hardware.control.minimum_jerk import PEAK
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.errors import CommandRefused, finite
from robocomp_dsl.hardware.rotations import Matrix

RATE = 100.0
"""Positions a second."""

DAMPING = 1e-4
"""On the way, where the arm is never far from its line."""

SLOWEST = 0.25
"""A line never goes slower than at this share of its speed."""

PULL = 0.1
"""The share of the way to the posture of the solution that is made up for in each step."""


class Unreachable(CommandRefused):
    """No posture of the arm brings the hand to the goal."""


class CartesianState(Enum):
    """What the controller does."""

    IDLE = "idle"
    MOVING = "moving"
    REACHED = "reached"
    INTERRUPTED = "interrupted"


class CartesianController:
    """Drives the joints of `chain`, which `board` knows as `joints`, in mode position-direct.

    One thread at a time, the one of the board.
    """

    def __init__(
        self, board: Board, chain: Chain, joints: tuple[str, ...], *, distance: float = 1.0
    ) -> None:
        self.chain, self.state = chain, CartesianState.IDLE
        self.distance, self.angle = distance, 0.01
        self._board, self._commands = board, Commands(board)
        self._joints = board.select.indices(joints)
        self._line: _Line | None = None
        self._q = np.zeros(len(joints))
        self._since = 0.0
        board.leaders.append(self.step)

    def pose(self) -> Matrix:
        """Where the hand is, from the measured joint angles, shape (4, 4) [mm]."""
        self._hold()
        return self.chain.pose(self._board.position[self._joints])

    def ask(self, goal: object) -> Solution:
        """The joint angles of a goal, and what they leave to be desired; nothing moves."""
        return solve(self.chain, goal_of(goal), self._here())

    def go_to(self, goal: object, seconds: float = 2.0) -> Solution:
        """Take the hand to a pose, (4, 4), or a place, (3,) [mm], in about `seconds`.

        Raises `Unreachable` with what is nearest, `CommandRefused`, or what the mode change raises.
        """
        finite(seconds=seconds)
        if seconds <= 0.0:
            raise CommandRefused(f"a motion takes more than {seconds:g} s")
        wanted = goal_of(goal)
        found = solve(self.chain, wanted, self._here())
        if not found.within(self.distance, self.angle):
            raise Unreachable(
                f"the hand cannot get there: the nearest that it gets is {found.distance:.1f} mm "
                f"and {math.degrees(found.angle):.1f}° away"
            )
        here = self._here()
        self._commands.set_mode(self._joints, Mode.POSITION_DIRECT)
        self._q = here
        self._line = _Line(self.chain.pose(here), here, wanted, found.q, seconds)
        self.state = CartesianState.MOVING
        return found

    def stop(self) -> None:
        """Stay where the hand is."""
        if self.state is CartesianState.MOVING:
            self._commands.stop(self._joints)
            self.state = CartesianState.IDLE

    def step(self, dt: float) -> None:
        """Called by the board at every step."""
        self._since += dt
        if self.state is not CartesianState.MOVING or self._since < 1.0 / RATE - 1e-9:
            return
        passed, self._since = self._since, 0.0
        assert self._line is not None  # noqa: S101  there is one as long as it moves
        self._q, done = self._next(self._line, passed)
        try:
            self._commands.set_position(self._joints, self._q)
        except WrongMode:
            self.state = CartesianState.INTERRUPTED
            return
        if done:
            self.state = CartesianState.REACHED

    def _next(self, line: _Line, dt: float) -> tuple[Floats, bool]:
        """Where the joints shall be after `dt` seconds, and whether that is the end."""
        speed = self._board.limits.speed[self._joints] / PEAK
        if line.time >= line.seconds:  # what the line has left over is made good joint by joint
            way = line.end - self._q
            share = min(1.0, dt / max(float((np.abs(way) / speed).max()), 1e-9))
            return self._q + share * way, share == 1.0
        ahead = min(line.time + dt, line.seconds)
        goal, posture = line.at(ahead)
        error = goal.error(self.chain.pose(self._q))
        damping = DAMPING + 0.5 * float(error @ error)
        way = step(self.chain, self._q, error, PULL * (posture - self._q), damping)
        share = min(1.0, dt / max(float((np.abs(way) / speed).max()), 1e-9))
        # joints at their speed limit: the line waits, but not for ever, since there are lines
        # that the arm cannot follow
        line.time += max(share, SLOWEST) * (ahead - line.time)
        return self._q + share * way, False

    def _here(self) -> Floats:
        """Where the references of the joints are, within the limits of the chain."""
        self._hold()
        here = self._board.references.position[self._joints]
        return np.clip(here, self.chain.low, self.chain.high)

    def _hold(self) -> None:
        """Other joints of the board that move the hand are taken as they stand."""
        for name in self.chain.held:
            if name in self._board.spec.names:
                self.chain.hold(name, float(self._board.position[self._board.select.index(name)]))


class _Line:
    """From one pose and posture to another, at rest on both ends; `time` is how far it has come."""

    def __init__(
        self, pose: Matrix, start: Floats, goal: Goal, end: Floats, seconds: float
    ) -> None:
        self._from, self._goal = pose, goal
        self._way = goal.place - pose[:3, 3]
        self._turn = None if goal.turn is None else rotation_vector(goal.turn @ pose[:3, :3].T)
        self.start, self.end, self.seconds, self.time = start, end, seconds, 0.0

    def at(self, time: float) -> tuple[Goal, Floats]:
        """The goal and the posture at `time`; minimum jerk from rest to rest."""
        t = time / self.seconds
        share = t**3 * (10.0 - 15.0 * t + 6.0 * t * t)
        posture = self.start + share * (self.end - self.start)
        place = self._from[:3, 3] + share * self._way
        if self._turn is None:
            return Goal(place), posture
        return Goal(place, _turn(share * self._turn) @ self._from[:3, :3]), posture


def _turn(vector: Floats) -> Matrix:
    """The rotation about `vector` by its length (Rodrigues' formula), shape (3, 3)."""
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    made: Matrix = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
    return made
