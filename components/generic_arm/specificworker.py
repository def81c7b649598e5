"""generic_arm: asks the boards where the arm is, tells it in generic units, and hands orders on."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from answers import position_of, rotation_of, told_chain, told_limits, told_pose, told_state
from board import Overtaken
from boards import joined
from control import AWAY, ArmControl, Beginning
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
from robocomp_dsl.tactile.arm.generic_arm import GenericArm, Orders
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.part_file import arm_part


class SpecificWorker(GenericWorker):
    """An arm of five joints that is the same on every robot, on top of the boards of a real arm.

    Boards are asked, not listened to: an answer that does not come is known at once, a board need
    not publish, and the arm has the rate that it is given here.
    """

    arm: GenericArm
    control: ArmControl
    told: str = ""

    def initialize(self) -> None:
        """Read the description; the boards are reached in `compute`, whenever they are there."""
        it = self.params
        proxies = {
            "board": self.board_proxy,
            "board2": self.board2_proxy,
            "board3": self.board3_proxy,
        }
        part = arm_part(it.description, it.part, self.config_file)
        for proxy in proxies.values():
            proxy.set_timeout(it.patience / 1000)
        boards = joined(part, it.description, proxies)
        self.log.info("%s: %s", it.part, boards)
        self.arm = GenericArm(part)
        begin = Beginning(it.begin, it.begin_speed, it.compliant)
        self.control = ArmControl(self.arm, boards, self.clock, begin)
        self.did_set_speed(1.0)
        self.did_set_hold(0.0)
        self.did_set_push_hold(0.0)
        self.did_set_period(0)

    def did_set_speed(self, _old: float) -> None:
        """All commands keep to the share of the speed limits."""
        self.arm.speed_limits = self.arm.part.speed_limits * self.params.speed

    def did_set_hold(self, _old: float) -> None:
        """What comes from now on lasts as long."""
        self.control.hold = self.params.hold

    def did_set_push_hold(self, _old: float) -> None:
        """The same for torques."""
        self.control.push_hold = self.params.push_hold

    def did_set_period(self, _old: int) -> None:
        """Another rate of reading and publishing."""
        self.set_period(self.params.period)

    def compute(self) -> None:
        """Ask where the arm is, go on with what lasts, tell the state."""
        warning = self.control.update()
        if warning:
            self.log.warning("%s", warning)
        self.genericarmstate_proxy.armState(told_state(self.arm, moving=self.control.moving))

    def emergency(self) -> None:
        """While time stands still no motion can be watched: stop, and take hold anew later."""
        if self.clock.silent:
            self.leave_standing()
            self.control.lose("nobody tells the time")

    def finalize(self) -> None:
        """Leave no arm moving."""
        if hasattr(self, "control"):  # not there after a wrong description
            self.leave_standing()

    def leave_standing(self) -> None:
        """Stop the arm, if it answers."""
        if not self.control.trouble:
            try:
                self.control.stop()
            except AWAY as error:
                self.log.info("the arm could not be stopped: %s", error)

    @contextmanager
    def in_words(self) -> Iterator[None]:
        """What goes wrong, as the exceptions that the interface declares."""
        if self.control.trouble:
            raise NotPossible(f"the arm does not answer: {self.control.trouble}")
        try:
            yield
        except errors.Unreachable as error:
            raise Unreachable(str(error), error.distance, error.angle) from None
        except MiddlewareError as error:
            raise NotPossible(f"the arm does not answer: {error}") from None
        except (*AWAY, Overtaken) as error:
            raise NotPossible(str(error)) from None

    @contextmanager
    def in_log(self, what: str) -> Iterator[None]:
        """The same for commands, whose callers get no answer."""
        try:
            with self.in_words():
                yield
        except NotPossible as error:
            if error.what != self.told:  # a stream of commands fails in the same way each time
                self.log.warning("`%s` is not carried out: %s", what, error.what)
            self.told = error.what
        else:
            self.told = ""

    def outcome(self, orders: Orders) -> Outcome:
        """Carry out orders; what of them was not possible."""
        return Outcome(self.control.carry_out(orders), orders.dropped)

    # implements RoboCompGenericArm::GenericArm

    def GenericArm_getState(self) -> ArmState:
        """Where the arm is and how it moves."""
        with self.in_words():
            return told_state(self.arm, moving=self.control.moving)

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
        """Go to angles, at these mean speeds or, without any, as fast as the limits allow."""
        with self.in_words():
            return self.outcome(self.arm.move(position, given(speed)))

    def GenericArm_moveBy(self, way: Angles, speed: Angles) -> Outcome:
        """Go by these angles from here."""
        with self.in_words():
            return self.outcome(self.arm.move_by(way, given(speed)))

    def GenericArm_reach(self, x: float, y: float, z: float) -> Outcome:
        """Bring the hand to a point."""
        with self.in_words():
            return self.outcome(self.arm.reach(np.array([x, y, z])))

    def GenericArm_reachPose(self, pose: Pose) -> Outcome:
        """Bring the hand to a point and a rotation."""
        with self.in_words():
            return self.outcome(self.arm.reach(position_of(pose), rotation_of(pose)))

    def GenericArm_follow(self, position: Angles) -> None:
        """Be at these angles at once; for streams of small steps."""
        with self.in_log("follow"):
            self.outcome(self.arm.follow(position))

    def GenericArm_drive(self, velocity: Angles) -> None:
        """Turn at these speeds until the next command."""
        with self.in_log("drive"):
            self.outcome(self.arm.drive(velocity))

    def GenericArm_push(self, torque: Angles) -> None:
        """Give these torques; a push that is not renewed ends."""
        with self.in_log("push"):
            self.outcome(self.arm.push(torque))

    def GenericArm_glide(self, vx: float, vy: float, vz: float) -> None:
        """Move the hand at this velocity until the next command."""
        with self.in_log("glide"):
            way = np.array([vx, vy, vz])
            self.control.carry_out(self.arm.glide(way), way)

    def GenericArm_setStiffness(self, stiffness: Angles, damping: Angles) -> None:
        """Give way like springs and dampers; two empty sequences make it stiff."""
        with self.in_words():
            self.control.soften(stiffness, damping)

    def GenericArm_stop(self) -> None:
        """End every motion."""
        with self.in_words():
            self.control.stop()


def given(speed: Angles) -> Floats | None:
    """The speeds, or None for an empty sequence."""
    return speed if len(speed) else None
