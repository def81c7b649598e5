"""The control boards of one arm as one device: joins readings and splits commands.

In: the joints of a generic part by the names of physical parts, a proxy for each part. Out:
readings (m,) of the arm's joints in generic order, and commands to the boards. Radians, N m, s.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from board import Board, CommandRefused, CommandSuperseded, Joints
from generic_arm_generated.interfaces import ControlBoardProxy, Impedance, InteractionMode

from robocomp_dsl.finding import Finding
from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.tactile.arm.generic_arm import Control, JointCommands
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import GenericPart


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """All joints of the arm (m,); `time` is that of the oldest board reading [s]."""

    time: float
    position: Floats
    velocity: Floats
    torque: Floats


class Boards:
    """All boards of an arm of `size` joints."""

    def __init__(self, boards: Sequence[Board], size: int) -> None:
        self.boards = tuple(boards)
        self._size = size
        self._commands = 0

    def reach(self) -> None:
        """Look up the joints on their boards. Raises `WrongBoard` and errors of the calls."""
        for board in self.boards:
            board.reach()

    def read(self) -> Reading:
        """Read the state of every board."""
        position, velocity, torque = (np.empty(self._size) for _ in range(3))
        time = np.inf
        for board in self.boards:
            state = board.read()
            at, rows = board.joints.at, board.rows
            position[at], velocity[at] = state.position[rows], state.velocity[rows]
            torque[at] = state.torque[rows]
            time = min(time, state.time)
        return Reading(time, position, velocity, torque)

    def send(self, commands: JointCommands, hold: float) -> Bools:
        """Send `commands`; returns which joints (m,) the boards have clipped.

        Velocities expire after `hold` s, 0: never. Raises `CommandSuperseded` if another command
        arrives while modes are being changed. If a board rejects the command, all boards stop.
        """
        proceed = self._begin()
        for board in self.boards:
            board.prepare(commands.control, _board_part(commands.speeds, board), proceed)
        clipped = np.zeros(self._size, bool)
        try:
            for board in self.boards:
                values = commands.values[board.joints.at]
                clipped[board.joints.at] = board.send(commands.control, values, hold, proceed)
        except Exception as error:
            if len(self.boards) > 1 and not isinstance(error, CommandSuperseded):
                self.stop()
            raise
        return clipped

    def moving(self) -> bool:
        """Whether a board is still moving to a goal."""
        return any(not board.arrived() for board in self.boards)

    def stop(self) -> None:
        """Stop every motion, on all boards."""
        self._begin()
        for board in self.boards:
            board.stop()

    def hold(self, share: float) -> None:
        """Hold the current angles of the arm; joints beyond the arm move to their fixed angles.

        These move at a `share` of their speed limits.
        """
        for board in self.boards:
            board.hold_others(share)
        proceed = self._begin()
        for board in self.boards:
            board.prepare(Control.POSITION, None, proceed)

    def soften(self, stiffness: Floats, damping: Floats) -> None:
        """Set springs [N m/rad] and dampers [N m s/rad] (m,), and make the joints compliant.

        If a board rejects them, the previous springs are restored on all boards.
        """
        impedances = [Impedance(k, d, 0.0) for k, d in zip(stiffness, damping, strict=True)]
        before = [board.springs() for board in self.boards]
        try:
            for board in self.boards:
                board.set_springs([impedances[i] for i in board.joints.at])
        except CommandRefused:
            for board, springs in zip(self.boards, before, strict=True):
                board.set_springs(springs)
            raise
        for board in self.boards:
            board.set_interaction_mode(InteractionMode.Compliant)

    def stiffen(self) -> None:
        """Make the joints stiff."""
        for board in self.boards:
            board.set_interaction_mode(InteractionMode.Stiff)

    def __str__(self) -> str:
        return ", ".join(
            f"{board.joints.part or 'the robot'} at {board.port}" for board in self.boards
        )

    def _begin(self) -> Callable[[], None]:
        """Start a command; the returned function raises if a later one has started."""
        self._commands += 1
        mine = self._commands

        def proceed() -> None:
            if self._commands != mine:
                raise CommandSuperseded("a later command replaced this one")

        return proceed


def create_boards(part: GenericPart, proxies: Mapping[str, ControlBoardProxy]) -> Boards:
    """The boards of `part`: one for each physical part, in the order of the ports.

    Raises `ConfigError` if there are more parts than ports, or no joints.
    """
    servos = [servo for servo in part.servos if servo.joint]
    physical = list(dict.fromkeys(servo.part for servo in servos))
    if not 0 < len(physical) <= len(proxies):
        message = f"`{part.name}` is on {len(physical)} physical parts: {', '.join(physical)}"
        help_text = f"there are ports for {len(proxies)}"
        raise ConfigError([Finding(part.place, message, help=help_text)])
    boards = []
    for name, (port, proxy) in zip(physical, proxies.items(), strict=False):
        at = np.flatnonzero([servo.part == name for servo in servos])
        names = tuple(servos[i].joint for i in at)
        held = {joint.joint: joint.position for joint in part.fixed_joints if joint.part == name}
        boards.append(Board(port, proxy, Joints(name, names, at, held)))
    return Boards(boards, len(servos))


def _board_part(values: Floats | None, board: Board) -> Floats | None:
    return None if values is None else values[board.joints.at]
