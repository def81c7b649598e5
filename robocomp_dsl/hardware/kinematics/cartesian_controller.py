"""A controller on a control board that moves an end effector to poses, on lines if possible.

In: goals in mm, in the base of the chain. Out: direct positions for the joints, at `RATE`. A goal
is solved before the joints move; during the motion, damped least squares follows a line with
minimum jerk, and the joint angles of the solution guide the null space.
"""

from __future__ import annotations

import math
from dataclasses import replace
from enum import Enum

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.errors import WrongMode
from robocomp_dsl.hardware.control.joints import Bools, Floats
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.control.trajectories.minimum_jerk import PEAK
from robocomp_dsl.hardware.devices.errors import CommandRefused, require_finite
from robocomp_dsl.hardware.kinematics.cartesian import LEVER, JointChain, goal_of, solve, step
from robocomp_dsl.hardware.kinematics.cartesian_line import LineMotion
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.tactile.arm.inverse import Goal, Solution

RATE = 100.0
"""Positions per second."""

DAMPING = 1e-4
"""Damping of the solver during a motion, when the arm is always close to its line."""

SLOWEST = 0.25
"""Minimum share of its speed at which a line proceeds."""

PULL = 0.1
"""Share of the distance to the posture of the solution that each step covers."""


class UnreachableGoal(CommandRefused):
    """No posture of the arm reaches the goal; `nearest` is the best solution."""

    def __init__(self, nearest: Solution) -> None:
        super().__init__(
            f"the hand cannot reach the goal: the nearest that it gets is "
            f"{nearest.distance:.1f} mm and {math.degrees(nearest.angle):.1f}° away"
        )
        self.nearest = nearest


class CartesianState(Enum):
    """State of the controller."""

    IDLE = "idle"
    MOVING = "moving"
    REACHED = "reached"
    INTERRUPTED = "interrupted"


class CartesianController:
    """Drives the joints of `chain`, which are `joints` on `board`, in mode position-direct.

    `seconds` is the default duration of a motion; a posture reaches a goal within `distance` [mm]
    and `angle` [rad]; `tracking`: after arrival the end effector is held at its goal, even when
    joints outside the chain move it. `joints` and `free` (n,) are those of the whole chain, and
    which of them may move. Not thread-safe: call it from the board's thread.
    """

    def __init__(
        self, board: Board, chain: JointChain, joints: tuple[str, ...], *, distance: float = 1.0
    ) -> None:
        self.chain, self.state = chain, CartesianState.IDLE
        self.distance, self.angle, self.seconds, self.tracking = distance, 0.01, 2.0, False
        self.joints, self.free = joints, np.ones(len(joints), bool)
        self.desired: Solution | None = None
        self._board, self._commands, self._whole = board, Commands(board), chain
        self._joints = board.select.indices(joints)
        self._line: LineMotion | None = None
        self._goal = Goal(np.zeros(3))
        self._q = np.zeros(len(joints))
        self._since = 0.0
        board.motion_overrides.append(self.step)

    def pose(self) -> Matrix:
        """Pose of the end effector from the measured joint angles, shape (4, 4) [mm]."""
        self._fix_other_joints()
        return self.chain.pose(self._board.position[self._joints])

    @property
    def posture(self) -> Floats:
        """References of all joints of the chain, (n,) [rad]."""
        return self._board.references.position[self._board.select.indices(self.joints)]

    def set_chain(self, chain: JointChain) -> None:
        """The same joints in another model of the same robot."""
        self._whole = chain
        self._select_joints()

    def set_free_joints(self, free: Bools) -> None:
        """Let only these joints of the chain move, (n,). Raises `CommandRefused`."""
        if len(free) != len(self.joints) or not np.any(free):
            raise CommandRefused(f"{len(self.joints)} joints need as many flags, one of them set")
        if self.state is CartesianState.MOVING:
            raise CommandRefused("the hand is on its way: stop it first")
        self.free, self.state = np.array(free, bool), CartesianState.IDLE
        self._select_joints()

    def _select_joints(self) -> None:
        """The chain of the joints that may move; the others are fixed."""
        whole, at = self._whole, np.flatnonzero(self.free)
        fixed = {self.joints[i]: whole.joints[i] for i in np.flatnonzero(~self.free).tolist()}
        self.chain = replace(
            whole,
            joints=tuple(whole.joints[i] for i in at.tolist()),
            low=whole.low[at],
            high=whole.high[at],
            rest=whole.rest[at],
            held=whole.held | fixed,
        )
        self._joints = self._board.select.indices(self.joints)[at]

    def nearest(self, goal: object) -> Solution:
        """The joint angles of a goal, and the remaining error; nothing moves."""
        return solve(self.chain, goal_of(goal), self._here())

    def solve(self, goal: object) -> Solution:
        """A solution within the tolerance. Raises `Unreachable`, `CommandRefused`."""
        found = self.nearest(goal)
        if not found.within(self.distance, self.angle):
            raise UnreachableGoal(found)
        return found

    def go_to(self, goal: object, seconds: float | None = None) -> Solution:
        """Move the end effector to a pose, (4, 4), or a position, (3,) [mm], in about `seconds`.

        Raises `Unreachable` with the best solution, `CommandRefused`, or the mode change's errors.
        """
        seconds = self.seconds if seconds is None else seconds
        require_finite(seconds=seconds)
        if seconds <= 0.0:
            raise CommandRefused(f"a motion takes more than {seconds:g} s")
        found, target, here = self.solve(goal), goal_of(goal), self._here()
        self._commands.set_mode(self._joints, Mode.POSITION_DIRECT)
        self._q, self._since = here, 0.0
        self._line = LineMotion(self.chain.pose(here), here, target, found.q, seconds)
        self.state, self.desired, self._goal = CartesianState.MOVING, found, target
        return found

    def stop(self) -> None:
        """Stop at the current pose."""
        if self.state is CartesianState.MOVING:
            self._commands.stop(self._joints)
        if self.state is not CartesianState.INTERRUPTED:
            self.state = CartesianState.IDLE

    def step(self, dt: float) -> None:
        """Called by the board at every step."""
        self._since += dt
        tracked = self.tracking and self.state is CartesianState.REACHED
        if not (tracked or self.state is CartesianState.MOVING) or self._since < 1.0 / RATE - 1e-9:
            return
        passed, self._since = self._since, 0.0
        assert self._line is not None  # noqa: S101  there is one as long as it moves
        self._fix_other_joints()
        self._q, done = self._track(passed) if tracked else self._next(self._line, passed)
        try:
            self._commands.set_position(self._joints, self._q)
        except WrongMode:
            self.state = CartesianState.INTERRUPTED
            return
        if done:
            self.state = CartesianState.REACHED

    def _next(self, line: LineMotion, dt: float) -> tuple[Floats, bool]:
        """The joint positions after `dt` seconds, and whether the motion is complete."""
        speed = self._board.limits.speed[self._joints] / PEAK
        if line.time >= line.seconds:  # the remaining error is corrected joint by joint
            way = line.end - self._q
            share = min(1.0, dt / max(float((np.abs(way) / speed).max()), 1e-9))
            return self._q + share * way, share == 1.0
        ahead = min(line.time + dt, line.seconds)
        goal, posture = line.goal_at(ahead)
        error = goal.error(self.chain.pose(self._q), LEVER)
        damping = DAMPING + 0.5 * float(error @ error)
        way = step(self.chain, self._q, goal, PULL * (posture - self._q), damping)
        share = min(1.0, dt / max(float((np.abs(way) / speed).max()), 1e-9))
        # joints at their speed limit: the line waits, but only for a limited time, because some
        # lines cannot be followed
        line.time += max(share, SLOWEST) * (ahead - line.time)
        return self._q + share * way, False

    def _track(self, dt: float) -> tuple[Floats, bool]:
        """The joint positions that hold the end effector at its goal."""
        way = step(self.chain, self._q, self._goal, 0.0 * self._q, DAMPING)
        most = self._board.limits.speed[self._joints] / PEAK * dt
        return self._q + np.clip(way, -most, most), True

    def _here(self) -> Floats:
        """The references of the joints, clipped to the limits of the chain."""
        self._fix_other_joints()
        here = self._board.references.position[self._joints]
        return np.clip(here, self.chain.low, self.chain.high)

    def _fix_other_joints(self) -> None:
        """Update the fixed joints that move the end effector from their measured positions."""
        for name in self.chain.held:
            if name in self._board.spec.names:
                self.chain.fix_joint(
                    name, float(self._board.position[self._board.select.index(name)])
                )
