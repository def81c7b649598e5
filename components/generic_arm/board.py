"""One control board, as far as the arm uses it: its joints, their modes, commands to them.

In: a proxy, the names of the joints. Out: what the board measures, and commands in the mode that
they need. Failures of the board keep their type; `Refusal` says what it refuses, and where.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from generated.interfaces import (
    BoardState,
    ControlBoardProxy,
    ControlMode,
    Impedance,
    InteractionMode,
    Refused,
    UnknownJoint,
    WrongMode,
)

from robocomp_dsl.tactile.arm.generic_arm import Control
from robocomp_dsl.tactile.arrays import Bools, Floats, Ints

MODES = {
    Control.POSITION: ControlMode.Position,
    Control.DIRECT: ControlMode.PositionDirect,
    Control.VELOCITY: ControlMode.Velocity,
    Control.TORQUE: ControlMode.Torque,
}


class Refusal(Exception):
    """A board does not do what it was told; the message has its words."""


class WrongBoard(Exception):
    """A board without the joints that the description expects."""


class Overtaken(Exception):
    """A command that was given up for a later one."""


@dataclass(frozen=True, slots=True, eq=False)
class Joints:
    """The joints `names` of the physical part `part`; `at` (k,) of the arm's joints (m,).

    `held` are joints beyond these, each with the angle at which it stays.
    """

    part: str
    names: tuple[str, ...]
    at: Ints
    held: Mapping[str, float]


class Board:
    """The board at the port `port`. `rows` (k,) are its numbers of the joints, after `reach`."""

    def __init__(self, port: str, proxy: ControlBoardProxy, joints: Joints) -> None:
        self.port, self.joints = port, joints
        self.rows: Ints = np.zeros(0, np.int64)
        self._proxy = proxy
        self._names, self._held = list(joints.names), list(joints.held)
        self._count, self._fastest = 0, np.zeros(0)
        self._modes: list[ControlMode] = []  # empty: not known
        self._changes, self._pushed = 0, False

    def reach(self) -> None:
        """Find the joints on the board. Raises `WrongBoard`, and what the call raises."""
        joints = self._proxy.getJoints()
        # a description may count joints instead of naming them
        found = {str(i): i for i in range(len(joints))}
        found |= {one.name: i for i, one in enumerate(joints)}
        missing = [name for name in (*self.joints.names, *self.joints.held) if name not in found]
        if missing:
            has = ", ".join(one.name for one in joints)
            raise WrongBoard(
                f"the board at `{self.port}` has no joint `{missing[0]}`, which the description"
                f" expects on `{self.joints.part}`; it has {has}: is the port wired to another"
                " board?"
            )
        self._count = len(joints)
        self.rows = np.array([found[name] for name in self.joints.names], np.int64)
        self._names = [joints[row].name for row in self.rows]
        held = [joints[found[name]] for name in self.joints.held]
        self._held = [one.name for one in held]
        self._fastest = np.array([one.speedLimit for one in held])

    def read(self) -> BoardState:
        """Everything it measured last. Raises `WrongBoard`, and `Refusal` for what is no number."""
        changes = self._changes
        state = self._proxy.getState()
        told = (state.position, state.velocity, state.torque)
        if any(len(one) != self._count for one in told) or len(state.modes) != self._count:
            raise WrongBoard(f"the board at `{self.port}` has other joints than before")
        wrong = ~np.isfinite([one[self.rows] for one in told]).all(axis=0)
        if wrong.any():
            name = self._names[int(np.argmax(wrong))]
            raise Refusal(f"`{self.port}` tells no numbers for `{name}`")
        if self._changes == changes:  # else a command changed them while this answer was on its way
            self._modes = [state.modes[row] for row in self.rows]
        return state

    def prepare(self, control: Control, speeds: Floats | None, proceed: Callable[[], None]) -> None:
        """Bring the joints into the mode that `control` needs; moves go at `speeds` (k,).

        `proceed` raises when that is no longer wanted.
        """
        with self._words():
            self._change(MODES[control])
            if speeds is not None:
                proceed()
                self._proxy.setReferenceSpeed(self._names, speeds)

    def send(
        self, control: Control, values: Floats, hold: float, proceed: Callable[[], None]
    ) -> Bools:
        """The command itself, (k,); which values the board clipped.

        Where somebody else has changed the mode meanwhile, it is changed back once, unless
        `proceed` raises.
        """
        proceed()
        with self._words():
            try:
                return self._command(control, values, hold)
            except WrongMode:
                proceed()
                self._modes = []
                self._change(MODES[control])
                proceed()
                return self._command(control, values, hold)

    def hold_others(self, share: float) -> None:
        """Send the held joints to where they stay, at a share of their speed limits."""
        names, angles = self._held, np.array(list(self.joints.held.values()))
        if names:  # an empty list would be all joints of the board
            with self._words():
                self._proxy.setControlMode(names, ControlMode.Position)
                self._proxy.setReferenceSpeed(names, share * self._fastest)
                self._proxy.positionMove(names, angles)

    def arrived(self) -> bool:
        """Whether no joint is on its way to a goal."""
        return bool(np.all(self._proxy.motionDone(self._names)))

    def stop(self) -> None:
        """End motions; joints that were pushed hold where they are."""
        with self._words():
            self._proxy.stopMotion(self._names)
            if self._pushed:
                self._change(ControlMode.Position)

    def springs(self) -> list[Impedance]:
        """Springs and dampers as they are set, (k,)."""
        return [self._proxy.getImpedance(name) for name in self._names]

    def set_springs(self, springs: Sequence[Impedance]) -> None:
        """Springs and dampers (k,)."""
        for name, one in zip(self._names, springs, strict=True):
            with self._words(f", {name}"):
                self._proxy.setImpedance(name, one)

    def interact(self, mode: InteractionMode) -> None:
        """Stiff, or giving way like the springs."""
        with self._words():
            self._proxy.setInteractionMode(self._names, mode)

    def _command(self, control: Control, values: Floats, hold: float) -> Bools:
        proxy, names = self._proxy, self._names
        if control is Control.POSITION:
            return np.asarray(proxy.positionMove(names, values))
        if control is Control.DIRECT:
            return np.asarray(proxy.setPosition(names, values))
        if control is Control.VELOCITY:
            return np.asarray(proxy.velocityMove(names, values, hold))
        return np.asarray(proxy.setTorque(names, values))

    def _change(self, mode: ControlMode) -> None:
        if any(one is not mode for one in self._modes) or not self._modes:
            self._changes += 1
            self._proxy.setControlMode(self._names, mode)
            self._modes = [mode] * len(self._names)
            self._pushed = mode is ControlMode.Torque

    @contextmanager
    def _words(self, about: str = "") -> Iterator[None]:
        """What the board refuses, with the port before it."""
        try:
            yield
        except (Refused, UnknownJoint, WrongMode) as error:
            self._modes = []  # whatever they are, they are not what was thought
            raise Refusal(f"`{self.port}`{about}: {error.what}") from None
