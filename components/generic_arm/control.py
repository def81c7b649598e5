"""The arm under control: where it is, what it was told, and what of that still lasts.

In: orders of the library, the boards, the time. Out: states and outcomes in generic units. A board
that fails makes the whole arm fail, until `update` has gone well again.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from board import Overtaken, Refusal, WrongBoard
from boards import Boards

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.tactile.arm.generic_arm import Control, GenericArm, Orders
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.description.model import Part
from robocomp_dsl.tactile.errors import TactileError

STILL = 0.02
"""A joint that turns slower than this has come to rest [rad/s]."""

AWAY = (MiddlewareError, Refusal, WrongBoard, TactileError)
"""What may go wrong with the boards; it is tried again until it goes well."""


@dataclass(frozen=True, slots=True)
class Beginning:
    """What happens when the boards are reached: `speed` is a share of the speed limits."""

    what: Literal["nothing", "hold", "start"]
    speed: float
    compliant: bool


class ArmControl:
    """`trouble` says why the arm does not answer, empty while it does; `moving` whether it moves.

    Speeds and glides end `hold` s after the last command, 0: never; torques `push_hold` s after it,
    since whoever pushes may have ended. Until then torques are renewed in every period: a board
    lets go of who falls silent.
    """

    def __init__(self, arm: GenericArm, boards: Boards, clock: Clock, begin: Beginning) -> None:
        self.arm, self.moving = arm, False
        self.hold = self.push_hold = 0.0
        self.trouble = "its boards have not been reached yet"
        self._boards, self._clock, self._begin = boards, clock, begin
        self._reached = self._known = False
        self._aiming, self._sent, self._sending = False, 0, 0
        self._glide: Floats | None = None
        self._push: Orders | None = None
        self._springs = _springs(arm.part) if begin.compliant else None
        self._ends = np.inf

    def update(self) -> str:
        """Reach the boards if need be, read them, go on with what lasts.

        The warning that there is to give, or nothing. Raises one of `AWAY`.
        """
        try:
            warning = "" if self._reached else self._reach()
            self._read()
            warning = self._go_on() or warning
        except Exception as error:
            self.lose(str(error) or type(error).__name__)
            raise
        self.trouble = ""
        return warning

    def lose(self, why: str) -> None:
        """The boards have to be reached anew; nobody knows what they do meanwhile."""
        self.trouble = why
        self._reached, self._ends = False, np.inf
        self._glide = self._push = None

    def carry_out(self, orders: Orders, glide: Floats | None = None) -> Bools:
        """Send orders, from now on renewed as `glide` (3,) wants; which angles (n,) were clipped.

        Raises one of `AWAY`, `Overtaken`.
        """
        self._sending += 1
        try:
            cut = self._boards.send(orders, self.hold)
        finally:
            self._sending -= 1
        lasts = {Control.VELOCITY: self.hold, Control.TORQUE: self.push_hold}
        self._ends = self._clock.now() + (lasts.get(orders.control, 0.0) or np.inf)
        self._glide = glide
        self._push = orders if orders.control is Control.TORQUE else None
        self._sent += 1
        self._aiming = orders.control is Control.POSITION
        self.moving |= self._aiming
        clipped = orders.clipped.copy()
        clipped[self.arm.mapping.present] |= cut
        return clipped

    def soften(self, stiffness: Floats, damping: Floats) -> None:
        """Generic springs and dampers (n,); empty ones make the joints stiff."""
        springs = None
        if len(stiffness) or len(damping):
            springs = self.arm.stiffness(stiffness, damping)
            self._boards.soften(*springs)
        else:
            self._boards.stiffen()
        self._springs = springs

    def stop(self) -> None:
        """End every motion."""
        self._glide = self._push = None
        self._ends, self._aiming = np.inf, False
        self._boards.stop()

    def _reach(self) -> str:
        self._boards.reach()
        self._read()
        again, self._reached, self._known = self._known, True, True
        if again:
            self.stop()  # nobody knows what became of the last command
        if self._begin.what == "nothing":
            return ""
        try:
            self._take_hold()
            if self._begin.what == "start" and not again:
                part = self.arm.part
                self.carry_out(self.arm.move(part.start, part.speed_limits * self._begin.speed))
        except Refusal as error:
            return f"the arm cannot be held: {error}"
        return ""

    def _take_hold(self) -> None:
        """Hold the arm, by the springs that were set last."""
        if self._springs is not None:
            self._boards.soften(*self._springs)
        self._boards.hold(self._begin.speed)

    def _read(self) -> None:
        sent = self._sent
        it = self._boards.read()
        state = self.arm.sense(it.time, it.position, it.velocity, it.torque)
        under_way = self._aiming and self._boards.moving()
        if self._sent == sent:  # else a goal came while this was asked
            self._aiming = under_way
        self.moving = self._aiming or bool((np.abs(state.velocity) > STILL).any())

    def _go_on(self) -> str:
        """Turn a glide into new joint speeds, push again; end what has lasted, or is refused."""
        if self._clock.now() >= self._ends:
            self.stop()
        elif not self._sending and (self._glide is not None or self._push is not None):
            what = "is pushed" if self._glide is None else "glides"
            orders = self._push if self._glide is None else self.arm.glide(self._glide)
            assert orders is not None  # noqa: S101  one of the two lasts
            try:
                self._boards.send(orders, self.hold)
            except Refusal as error:
                self.stop()
                return f"the hand {what} no further: {error}"
            except Overtaken:
                pass  # by a command that will tell what comes next
        return ""


def _springs(part: Part) -> tuple[Floats, Floats]:
    """Stiffness and damping of the joints that exist, as the description has them."""
    servos = [one for one in part.servos if one.joint]
    return np.array([one.stiffness for one in servos]), np.array([one.damping for one in servos])
