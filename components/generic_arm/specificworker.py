"""generic_arm: asks the boards where the arm is, tells it in generic units, and hands orders on."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from answers import position_of, rotation_of, told_chain, told_limits, told_pose, told_state
from board import Overtaken, Refusal, WrongBoard
from boards import Boards, joined
from found_part import found_part
from generated.genericworker import GenericWorker
from generated.interfaces import (
    Angles,
    ArmLimits,
    ArmState,
    Chain,
    NotPossible,
    Outcome,
    Pose,
    Unreachable,
)

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.tactile import errors
from robocomp_dsl.tactile.arm.generic_arm import Control, GenericArm, Orders
from robocomp_dsl.tactile.arrays import Floats

STILL = 0.02
"""A joint that turns slower than this has come to rest [rad/s]."""

AWAY = (MiddlewareError, Refusal, WrongBoard, errors.TactileError)
"""What may go wrong with the boards; it is tried again until it goes well."""


class SpecificWorker(GenericWorker):
    """An arm of five joints that is the same on every robot, on top of the boards of a real arm.

    Boards are asked, not listened to: an answer that does not come is known at once, a board need
    not publish, and the arm has the rate that it is given here.
    """

    boards: Boards
    arm: GenericArm

    def initialize(self) -> None:
        """Read the description; the boards are reached in `compute`, whenever they are there."""
        part = found_part(self.params.description, self.params.part, self.config_file)
        self.arm = GenericArm(part)
        proxies = [("board", self.board_proxy)]
        for _, proxy in proxies:
            proxy.set_timeout(self.params.patience / 1000)
        self.boards = joined(part, proxies)
        self.trouble, self.reached, self.was_reached = "it has not been reached yet", False, False
        self.aiming, self.moving, self.sent = False, False, 0
        self.gliding: Floats | None = None
        self.ends = np.inf
        self.did_set_speed(1.0)
        self.did_set_period(0)

    def did_set_speed(self, _old: float) -> None:
        """All commands keep to the share of the speed limits."""
        self.arm.speed_limits = self.arm.part.speed_limits * self.params.speed

    def did_set_period(self, _old: int) -> None:
        """Another rate of reading and publishing."""
        self.set_period(self.params.period)

    def compute(self) -> None:
        """Ask where the arm is, go on with what lasts, tell the state."""
        try:
            if not self.reached:
                self.reach_boards()
            self.read()
            self.go_on()
        except AWAY as error:
            self.trouble, self.reached, self.gliding, self.ends = str(error), False, None, np.inf
            raise
        self.trouble = ""
        self.genericarmstate_proxy.armState(told_state(self.arm, moving=self.moving))

    def reach_boards(self) -> None:
        """Find the joints; where the arm is held from, or goes to, `begin` says."""
        self.boards.reach()
        self.read()
        if self.was_reached:
            self.boards.stop()  # nobody knows what happened while they were away
        if self.params.begin != "nothing":
            try:
                self.begin_to_hold()
            except Refusal as error:
                self.log.warning("the arm cannot be held: %s", error)
        self.reached = self.was_reached = True
        self.log.info("the arm is %s of %s", self.params.part, self.boards)

    def begin_to_hold(self) -> None:
        """Hold the arm, as a spring if that is asked for, or send it to its start pose."""
        if self.params.compliant:
            servos = [one for one in self.arm.part.servos if one.joint]
            stiffness, damping = ([getattr(s, w) for s in servos] for w in ("stiffness", "damping"))
            self.boards.soften(np.array(stiffness), np.array(damping))
        self.boards.hold()
        if self.params.begin == "start":
            speed = self.arm.part.speed_limits * self.params.begin_speed
            self.carry_out(self.arm.move(self.arm.part.start, speed))

    def read(self) -> None:
        """Take in where the arm is, and whether it is on its way."""
        sent = self.sent
        it = self.boards.read()
        state = self.arm.sense(it.time, it.position, it.velocity, it.torque)
        under_way = self.aiming and self.boards.moving()
        if self.sent == sent:  # else a goal came while this was asked
            self.aiming = under_way
        self.moving = self.aiming or bool((np.abs(state.velocity) > STILL).any())

    def go_on(self) -> None:
        """Turn a glide into new joint speeds; end what has lasted for `hold`."""
        if self.clock.now() >= self.ends:
            self.end()
        elif self.gliding is not None:
            self.boards.send(self.arm.glide(self.gliding), self.params.hold)

    def end(self) -> None:
        """Stop the arm."""
        self.gliding, self.ends, self.aiming = None, np.inf, False
        self.boards.stop()

    def carry_out(self, orders: Orders, glide: Floats | None = None) -> Outcome:
        """Send orders; what of them was not possible."""
        lasts = orders.control in (Control.VELOCITY, Control.TORQUE) and self.params.hold > 0
        self.gliding = glide
        self.ends = self.clock.now() + self.params.hold if lasts else np.inf
        cut = self.boards.send(orders, self.params.hold)
        self.sent += 1
        self.aiming = orders.control is Control.POSITION
        self.moving |= self.aiming
        clipped = orders.clipped.copy()
        clipped[self.arm.mapping.present] |= cut
        return Outcome(clipped, orders.dropped)

    @contextmanager
    def in_words(self) -> Iterator[None]:
        """What goes wrong, as the exceptions that the interface declares."""
        if self.trouble:
            raise NotPossible(f"the arm does not answer: {self.trouble}")
        try:
            yield
        except errors.Unreachable as error:
            raise Unreachable(str(error), error.distance, error.angle) from None
        except (errors.TactileError, Refusal, Overtaken) as error:
            raise NotPossible(str(error)) from None
        except MiddlewareError as error:
            raise NotPossible(f"the arm does not answer: {error}") from None

    @contextmanager
    def in_log(self, what: str) -> Iterator[None]:
        """The same for commands, whose callers get no answer."""
        try:
            with self.in_words():
                yield
        except NotPossible as error:
            self.log.warning("`%s` is not carried out: %s", what, error.what)

    def finalize(self) -> None:
        """Leave no arm moving."""
        if self.reached:
            try:
                self.boards.stop()
            except AWAY as error:
                self.log.info("the arm could not be stopped: %s", error)

    # implements RoboCompGenericArm::GenericArm

    def GenericArm_getState(self) -> ArmState:
        """Where the arm is and how it moves."""
        with self.in_words():
            return told_state(self.arm, moving=self.moving)

    def GenericArm_getLimits(self) -> ArmLimits:
        """Its limits, and which joints there are."""
        return told_limits(self.arm)

    def GenericArm_getChain(self) -> Chain:
        """Its kinematic chain in generic angles."""
        try:
            return told_chain(self.arm.chain)
        except errors.NoChain as error:
            raise NotPossible(str(error)) from None

    def GenericArm_getHand(self) -> Pose:
        """Where the hand is."""
        with self.in_words():
            return told_pose(self.arm.hand())

    def GenericArm_move(self, position: Angles, speed: Angles) -> Outcome:
        """Go to angles, at these speeds or, without any, at the largest."""
        with self.in_words():
            return self.carry_out(self.arm.move(position, given(speed)))

    def GenericArm_moveBy(self, way: Angles, speed: Angles) -> Outcome:
        """Go by these angles from here."""
        with self.in_words():
            return self.carry_out(self.arm.move_by(way, given(speed)))

    def GenericArm_reach(self, x: float, y: float, z: float) -> Outcome:
        """Bring the hand to a point."""
        with self.in_words():
            return self.carry_out(self.arm.reach(np.array([x, y, z])))

    def GenericArm_reachPose(self, pose: Pose) -> Outcome:
        """Bring the hand to a point and a rotation."""
        with self.in_words():
            return self.carry_out(self.arm.reach(position_of(pose), rotation_of(pose)))

    def GenericArm_follow(self, position: Angles) -> None:
        """Be at these angles at once; for streams of small steps."""
        with self.in_log("follow"):
            self.carry_out(self.arm.follow(position))

    def GenericArm_drive(self, velocity: Angles) -> None:
        """Turn at these speeds until the next command."""
        with self.in_log("drive"):
            self.carry_out(self.arm.drive(velocity))

    def GenericArm_push(self, torque: Angles) -> None:
        """Give these torques until the next command."""
        with self.in_log("push"):
            self.carry_out(self.arm.push(torque))

    def GenericArm_glide(self, vx: float, vy: float, vz: float) -> None:
        """Move the hand at this velocity until the next command."""
        with self.in_log("glide"):
            velocity = np.array([vx, vy, vz])
            self.carry_out(self.arm.glide(velocity), velocity)

    def GenericArm_setStiffness(self, stiffness: Angles, damping: Angles) -> None:
        """Give way like springs and dampers; two empty sequences make it stiff."""
        with self.in_words():
            if len(stiffness) or len(damping):
                self.boards.soften(*self.arm.stiffness(stiffness, damping))
            else:
                self.boards.stiffen()

    def GenericArm_stop(self) -> None:
        """End every motion."""
        with self.in_words():
            self.end()


def given(speed: Angles) -> Floats | None:
    """The speeds, or None for an empty sequence."""
    return speed if len(speed) else None
