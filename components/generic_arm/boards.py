"""The control boards of one arm as one device: readings joined, orders taken apart.

In: the joints of a generic part by the names of physical parts, a proxy for each part. Out:
readings (m,) of the arm's joints in generic order, and commands to the boards. Radians, N m, s.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from board import Board, Joints, Overtaken, Refusal
from generated.interfaces import ControlBoardProxy, Impedance, InteractionMode

from robocomp_dsl.runtime.parameters import ConfigError, Finding, Place
from robocomp_dsl.runtime.parameters.findings import Text
from robocomp_dsl.tactile.arm.generic_arm import Control, Orders
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import Part


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """All of the arm's joints (m,); `time` is that of the board that was read longest ago."""

    time: float
    position: Floats
    velocity: Floats
    torque: Floats


class Boards:
    """Every board of an arm of `size` joints."""

    def __init__(self, boards: Sequence[Board], size: int) -> None:
        self.boards = tuple(boards)
        self._size = size
        self._commands = 0

    def reach(self) -> None:
        """Find the joints on their boards. Raises `WrongBoard`, and what a call raises."""
        for one in self.boards:
            one.reach()

    def read(self) -> Reading:
        """Ask every board where its joints are."""
        position, velocity, torque = (np.empty(self._size) for _ in range(3))
        time = np.inf
        for one in self.boards:
            state = one.read()
            at, rows = one.joints.at, one.rows
            position[at], velocity[at] = state.position[rows], state.velocity[rows]
            torque[at] = state.torque[rows]
            time = min(time, state.time)
        return Reading(time, position, velocity, torque)

    def send(self, orders: Orders, hold: float) -> Bools:
        """Carry out `orders`; which joints (m,) the boards have clipped.

        Velocities end after `hold` s, 0: never. Raises `Overtaken` when another command came while
        the modes were being changed. When a board refuses, all stop.
        """
        proceed = self._begin()
        for one in self.boards:
            one.prepare(orders.control, _part(orders.speeds, one), proceed)
        clipped = np.zeros(self._size, bool)
        try:
            for one in self.boards:
                values = orders.values[one.joints.at]
                clipped[one.joints.at] = one.send(orders.control, values, hold, proceed)
        except Exception as error:
            if len(self.boards) > 1 and not isinstance(error, Overtaken):
                self.stop()
            raise
        return clipped

    def moving(self) -> bool:
        """Whether a board is still on its way to a goal."""
        return any(not one.arrived() for one in self.boards)

    def stop(self) -> None:
        """End every motion, on all boards."""
        self._begin()
        for one in self.boards:
            one.stop()

    def hold(self, share: float) -> None:
        """Let the joints keep the angles that they have; those beyond the arm go to theirs.

        They do at a `share` of their speed limits.
        """
        for one in self.boards:
            one.hold_others(share)
        proceed = self._begin()
        for one in self.boards:
            one.prepare(Control.POSITION, None, proceed)

    def soften(self, stiffness: Floats, damping: Floats) -> None:
        """Springs [N m/rad] and dampers [N m s/rad] (m,) instead of stiff joints.

        When a board refuses them, all springs are again what they were.
        """
        wanted = [Impedance(k, d, 0.0) for k, d in zip(stiffness, damping, strict=True)]
        before = [one.springs() for one in self.boards]
        try:
            for one in self.boards:
                one.set_springs([wanted[i] for i in one.joints.at])
        except Refusal:
            for one, springs in zip(self.boards, before, strict=True):
                one.set_springs(springs)
            raise
        for one in self.boards:
            one.interact(InteractionMode.Compliant)

    def stiffen(self) -> None:
        """Stiff joints."""
        for one in self.boards:
            one.interact(InteractionMode.Stiff)

    def __str__(self) -> str:
        return ", ".join(f"{one.joints.part or 'the robot'} at {one.port}" for one in self.boards)

    def _begin(self) -> Callable[[], None]:
        """A new command; what it calls says whether it is still the latest."""
        self._commands += 1
        mine = self._commands

        def proceed() -> None:
            if self._commands != mine:
                raise Overtaken("another command came first")

        return proceed


def joined(part: Part, file: str, proxies: Mapping[str, ControlBoardProxy]) -> Boards:
    """The boards of `part` of `file`: its physical parts, at the ports in their order.

    Raises `ConfigError` where there is no port for one of them, or no joint at all.
    """
    servos = [one for one in part.servos if one.joint]
    physical = list(dict.fromkeys(one.part for one in servos))
    if not 0 < len(physical) <= len(proxies):
        said = f"`{part.name}` is on {len(physical)} physical parts: {', '.join(physical)}"
        place = Place(Text(file, ()), part.place.line, part.place.column)
        raise ConfigError([Finding(place, said, help=f"there are ports for {len(proxies)}")])
    boards = []
    for name, (port, proxy) in zip(physical, proxies.items(), strict=False):
        at = np.flatnonzero([one.part == name for one in servos])
        names = tuple(servos[i].joint for i in at)
        held = {one.joint: one.at for one in part.held if one.part == name}
        boards.append(Board(port, proxy, Joints(name, names, at, held)))
    return Boards(boards, len(servos))


def _part(values: Floats | None, board: Board) -> Floats | None:
    return None if values is None else values[board.joints.at]
