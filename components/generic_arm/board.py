"""One control board with the joints of the arm: measurements, modes, commands.

In: a proxy, the names of the joints. Out: measurements, and commands after the switch to the mode
that they need. Middleware errors are passed on; a rejected command raises `CommandRefused`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
from generic_arm_generated.interfaces import (
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


class CommandRefused(Exception):
    """A board rejects a command; the message is the board's."""


class WrongBoard(Exception):
    """A board lacks joints that the description expects."""


class CommandSuperseded(Exception):
    """A later command replaced this one before it was sent."""


@dataclass(frozen=True, slots=True, eq=False)
class Joints:
    """The joints `names` of the physical part `part`; `at` (k,) are their indices in the arm (m,).

    `held` are further joints, each with the angle at which it is fixed.
    """

    part: str
    names: tuple[str, ...]
    at: Ints
    held: Mapping[str, float]


class Board:
    """The board at the port `port`. `rows` (k,) are the joints' indices on it, after `reach`."""

    def __init__(self, port: str, proxy: ControlBoardProxy, joints: Joints) -> None:
        self.port, self.joints = port, joints
        self.rows: Ints = np.zeros(0, np.int64)
        self._proxy = proxy
        self._names, self._held = list(joints.names), list(joints.held)
        self._count, self._fastest = 0, np.zeros(0)
        self._modes: list[ControlMode] = []  # empty: not known
        self._changes, self._in_torque_mode = 0, False

    def reach(self) -> None:
        """Look up the joints on the board. Raises `WrongBoard` and errors of the call."""
        joints = self._proxy.getJoints()
        # a description may number joints instead of naming them
        found = {str(i): i for i in range(len(joints))}
        found |= {joint.name: i for i, joint in enumerate(joints)}
        missing = [name for name in (*self.joints.names, *self.joints.held) if name not in found]
        if missing:
            has = ", ".join(joint.name for joint in joints)
            raise WrongBoard(
                f"the board at `{self.port}` has no joint `{missing[0]}`, which the description"
                f" expects on `{self.joints.part}`; it has {has}: is the port connected to another"
                " board?"
            )
        self._count = len(joints)
        self.rows = np.array([found[name] for name in self.joints.names], np.int64)
        self._names = [joints[row].name for row in self.rows]
        held = [joints[found[name]] for name in self.joints.held]
        self._held = [joint.name for joint in held]
        self._fastest = np.array([joint.speedLimit for joint in held])

    def read(self) -> BoardState:
        """The latest measurements. Raises `WrongBoard`; `CommandRefused` for NaN or infinity."""
        changes = self._changes
        state = self._proxy.getState()
        columns = (state.position, state.velocity, state.torque)
        if any(len(column) != self._count for column in (*columns, state.modes)):
            raise WrongBoard(f"the board at `{self.port}` has other joints than before")
        wrong = ~np.isfinite([column[self.rows] for column in columns]).all(axis=0)
        if wrong.any():
            name = self._names[int(np.argmax(wrong))]
            raise CommandRefused(f"`{self.port}` reports values that are not finite for `{name}`")
        if self._changes == changes:  # otherwise a command changed them during this call
            self._modes = [state.modes[row] for row in self.rows]
        return state

    def prepare(self, control: Control, speeds: Floats | None, proceed: Callable[[], None]) -> None:
        """Switch the joints to the mode that `control` needs, and set `speeds` (k,) in rad/s.

        `proceed` raises `CommandSuperseded` if a later command has started.
        """
        with self._translate_refusals():
            self._change(MODES[control])
            if speeds is not None:
                proceed()
                self._proxy.setReferenceSpeed(self._names, speeds)

    def send(
        self, control: Control, values: Floats, hold: float, proceed: Callable[[], None]
    ) -> Bools:
        """Send the command (k,); returns which values the board clipped.

        If another client has changed the mode meanwhile, it is changed back once, unless `proceed`
        raises.
        """
        proceed()
        with self._translate_refusals():
            try:
                return self._command(control, values, hold)
            except WrongMode:
                proceed()
                self._modes = []
                self._change(MODES[control])
                proceed()
                return self._command(control, values, hold)

    def hold_others(self, share: float) -> None:
        """Move the held joints to their fixed angles, at a share of their speed limits."""
        names, angles = self._held, np.array(list(self.joints.held.values()))
        if names:  # an empty list would mean all joints of the board
            with self._translate_refusals():
                self._proxy.setControlMode(names, ControlMode.Position)
                self._proxy.setReferenceSpeed(names, share * self._fastest)
                self._proxy.positionMove(names, angles)

    def arrived(self) -> bool:
        """Whether no joint is moving to a goal."""
        return bool(np.all(self._proxy.motionDone(self._names)))

    def stop(self) -> None:
        """Stop all motions; joints in torque mode hold their position."""
        with self._translate_refusals():
            self._proxy.stopMotion(self._names)
            if self._in_torque_mode:
                self._change(ControlMode.Position)

    def springs(self) -> list[Impedance]:
        """The current springs and dampers, (k,)."""
        return [self._proxy.getImpedance(name) for name in self._names]

    def set_springs(self, springs: Sequence[Impedance]) -> None:
        """Set springs and dampers (k,)."""
        for name, spring in zip(self._names, springs, strict=True):
            with self._translate_refusals(f", {name}"):
                self._proxy.setImpedance(name, spring)

    def set_interaction_mode(self, mode: InteractionMode) -> None:
        """Make the joints stiff, or compliant by their springs."""
        with self._translate_refusals():
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
        if any(current is not mode for current in self._modes) or not self._modes:
            self._changes += 1
            self._proxy.setControlMode(self._names, mode)
            self._modes = [mode] * len(self._names)
            self._in_torque_mode = mode is ControlMode.Torque

    @contextmanager
    def _translate_refusals(self, about: str = "") -> Iterator[None]:
        """Raise `CommandRefused` for a rejected call; its message starts with the port."""
        try:
            yield
        except (Refused, UnknownJoint, WrongMode) as error:
            self._modes = []  # unknown now
            raise CommandRefused(f"`{self.port}`{about}: {error.what}") from None
