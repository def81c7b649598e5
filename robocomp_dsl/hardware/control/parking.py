"""Parking: move joints to a pose in which they may be switched off, and switch them off.

In: a pose and a speed. Out: commands to the board: position mode, one trajectory, then idle.
"""

from __future__ import annotations

from enum import Enum

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.control.joints import Floats, Ints, numbers
from robocomp_dsl.hardware.control.modes import Mode

ARRIVED = 0.05
"""A joint within this distance counts as parked [rad]."""


class ParkState(Enum):
    """Parking state of one joint."""

    AWAY = "away"
    PARKING = "parking"
    PARKED = "parked"
    FAILED = "failed"


class Parking:
    """Parking of the joints of one board."""

    def __init__(
        self, board: Board, pose: Floats, speed: float = 0.3, timeout: float = 20.0
    ) -> None:
        n = len(board.spec.joints)
        if speed <= 0.0:
            raise BadValue("the parking speed must be positive")
        self.pose, _ = board.limits.clip(np.arange(n), numbers("pose", pose, n))
        self.states = [ParkState.AWAY] * n
        self._board, self._speed, self._timeout = board, speed, timeout
        self._elapsed = np.zeros(n)
        self._leading = False
        board.motion_overrides.append(self.step)

    def park(self, joints: Ints | None = None) -> None:
        """Start with `joints`, or all. Raises `ModeRefused` for faults and missing calibration."""
        chosen = self._board.select.indices(joints)
        self._board.set_modes(chosen, [Mode.POSITION] * len(chosen))
        speed = np.full(len(chosen), self._speed)
        goal = self.pose[chosen]
        self._board.references.move(chosen, goal, self._board.dt, speed)
        self._elapsed[chosen] = 0.0
        for joint in chosen.tolist():
            self.states[joint] = ParkState.PARKING
        self._leading = True

    def quit(self, joints: Ints | None = None) -> None:
        """Abort; moving joints stop at their position, in position mode."""
        chosen = self._board.select.indices(joints).tolist()
        away = [i for i in chosen if self.states[i] is ParkState.PARKING]
        self._board.references.stop(np.array(away, dtype=np.int64))
        for joint in away:
            self.states[joint] = ParkState.AWAY

    def leads_any(self, joints: Ints) -> bool:
        """Whether any of `joints` is still being parked."""
        return any(self.states[i] is ParkState.PARKING for i in joints.tolist())

    @property
    def busy(self) -> bool:
        """Whether any joint is still being parked."""
        return ParkState.PARKING in self.states

    def step(self, dt: float) -> None:
        """Called by the board at every step."""
        if not self._leading:
            return
        for joint, state in enumerate(self.states):
            if state is ParkState.PARKING:
                self._watch(joint, dt)
        self._leading = self.busy

    def _watch(self, joint: int, dt: float) -> None:
        board = self._board
        self._elapsed[joint] += dt
        off = abs(board.position[joint] - self.pose[joint])
        if board.table.modes[joint] is not Mode.POSITION or self._elapsed[joint] > self._timeout:
            self.states[joint] = ParkState.FAILED
        elif not board.references.trajectory.moving[joint] and off < ARRIVED:
            self.states[joint] = ParkState.PARKED
            whole = board.table.coupled(np.array([joint]))
            if all(self.states[i] is not ParkState.PARKING for i in whole.tolist()):
                board.set_modes(np.array([joint]), [Mode.IDLE])
