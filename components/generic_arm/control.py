"""Controls the arm: its state, the current command, and commands that must be renewed.

In: commands of the library, the boards, the time. Out: states and outcomes in generic units. If one
board fails the whole arm fails, until `update` succeeds again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from board import CommandRefused, CommandSuperseded, WrongBoard
from boards import Boards

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.tactile.arm.generic_arm import Control, GenericArm, JointCommands
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import GenericPart
from robocomp_dsl.tactile.errors import TactileError

STILL = 0.02
"""A joint that turns slower than this is at rest [rad/s]."""

ARM_ERRORS = (MiddlewareError, CommandRefused, WrongBoard, TactileError)
"""Errors of the boards that are retried until they recover."""


@dataclass(frozen=True, slots=True)
class StartAction:
    """What happens when the boards are first reached: `speed` is a share of the speed limits."""

    action: Literal["nothing", "hold", "start"]
    speed: float
    compliant: bool


class ArmControl:
    """`trouble` says why the arm does not reply, empty while it does; `moving` whether it moves.

    Velocities expire `hold` s after the last command, 0: never; torques after `push_hold` s, so a
    crashed client cannot keep pushing. Until then torques are resent in every period, because a
    board releases joints without new references.
    """

    def __init__(self, arm: GenericArm, boards: Boards, clock: Clock, begin: StartAction) -> None:
        self.arm, self.moving = arm, False
        self.hold = self.push_hold = 0.0
        self.trouble = "its boards have not been reached yet"
        self._boards, self._clock, self._begin = boards, clock, begin
        self._reached = self._known = False
        self._aiming, self._sent, self._sending = False, 0, 0
        self._glide: Floats | None = None
        self._push: JointCommands | None = None
        self._springs = _springs(arm.part) if begin.compliant else None
        self._ends = np.inf

    def update(self) -> str:
        """Connect to the boards if necessary, read them, and renew the current command.

        Returns a warning, or an empty string. Raises one of `ARM_ERRORS`.
        """
        try:
            warning = "" if self._reached else self._reach()
            self._read()
            warning = self._renew_commands() or warning
        except Exception as error:
            self.lose(str(error) or type(error).__name__)
            raise
        self.trouble = ""
        return warning

    def lose(self, why: str) -> None:
        """Record that the arm is unreachable; the boards are looked up again."""
        self.trouble = why
        self._reached, self._ends = False, np.inf
        self._glide = self._push = None

    def carry_out(self, commands: JointCommands, glide: Floats | None = None) -> Bools:
        """Send commands; returns which angles (n,) were clipped.

        `glide` (3,) is a velocity of the end effector in m/s; joint speeds follow from it in every
        period. Raises one of `ARM_ERRORS`, `CommandSuperseded`.
        """
        self._sending += 1
        try:
            cut = self._boards.send(commands, self.hold)
        finally:
            self._sending -= 1
        lasts = {Control.VELOCITY: self.hold, Control.TORQUE: self.push_hold}
        self._ends = self._clock.now() + (lasts.get(commands.control, 0.0) or np.inf)
        self._glide = glide
        self._push = commands if commands.control is Control.TORQUE else None
        self._sent += 1
        self._aiming = commands.control is Control.POSITION
        self.moving |= self._aiming
        clipped = commands.clipped.copy()
        clipped[self.arm.mapping.present] |= cut
        return clipped

    def soften(self, stiffness: Floats, damping: Floats) -> None:
        """Set generic springs and dampers (n,); empty ones make the joints stiff."""
        springs = None
        if len(stiffness) or len(damping):
            springs = self.arm.stiffness(stiffness, damping)
            self._boards.soften(*springs)
        else:
            self._boards.stiffen()
        self._springs = springs

    def stop(self) -> None:
        """Stop every motion."""
        self._glide = self._push = None
        self._ends, self._aiming = np.inf, False
        self._boards.stop()

    def _reach(self) -> str:
        self._boards.reach()
        self._read()
        was_known, self._reached, self._known = self._known, True, True
        if was_known:
            self.stop()  # the state of the last command is unknown
        if self._begin.action == "nothing":
            return ""
        try:
            self._hold_arm()
            if self._begin.action == "start" and not was_known:
                part = self.arm.part
                self.carry_out(
                    self.arm.position_move(part.start, part.speed_limits * self._begin.speed)
                )
        except CommandRefused as error:
            return f"the arm cannot be held: {error}"
        return ""

    def _hold_arm(self) -> None:
        """Hold the arm with the current springs."""
        if self._springs is not None:
            self._boards.soften(*self._springs)
        self._boards.hold(self._begin.speed)

    def _read(self) -> None:
        sent = self._sent
        reading = self._boards.read()
        state = self.arm.update_state(
            reading.time, reading.position, reading.velocity, reading.torque
        )
        in_motion = self._aiming and self._boards.moving()
        if self._sent == sent:  # otherwise a goal was sent during the call
            self._aiming = in_motion
        self.moving = self._aiming or bool((np.abs(state.velocity) > STILL).any())

    def _renew_commands(self) -> str:
        """Resend a line motion or torques; stop when they expire or are rejected."""
        if self._clock.now() >= self._ends:
            self.stop()
        elif not self._sending and (self._glide is not None or self._push is not None):
            motion = "torque control" if self._glide is None else "line motion"
            commands = self._push if self._glide is None else self.arm.line_move(self._glide)
            assert commands is not None  # noqa: S101  one of the two is active
            try:
                self._boards.send(commands, self.hold)
            except CommandRefused as error:
                self.stop()
                return f"{motion} of the hand ended: {error}"
            except CommandSuperseded:
                pass  # the later command decides how the motion continues
        return ""


def _springs(part: GenericPart) -> tuple[Floats, Floats]:
    """Stiffness and damping of the joints that exist, from the description."""
    servos = [servo for servo in part.servos if servo.joint]
    return np.array([servo.stiffness for servo in servos]), np.array(
        [servo.damping for servo in servos]
    )
