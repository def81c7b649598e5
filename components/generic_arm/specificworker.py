"""generic_arm: reads the boards, publishes the state in generic units, forwards commands."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from board import CommandSuperseded
from boards import create_boards
from control import ARM_ERRORS, ArmControl, StartAction
from generic_arm_generated.genericworker import GenericWorker
from generic_arm_generated.interfaces import (
    Angles,
    ArmLimits,
    ArmState,
    Chain,
    NotPossible,
    Outcome,
    Pose,
    Unreachable,
)
from messages import (
    chain_to_message,
    limits_to_message,
    pose_to_message,
    position_of,
    rotation_of,
    state_to_message,
)

from robocomp_dsl.runtime.clock import CLOCK_LOST
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.tactile import errors
from robocomp_dsl.tactile.arm.generic_arm import GenericArm, JointCommands
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.part_file import load_arm_part


class SpecificWorker(GenericWorker):
    """A robot-independent arm of five joints, on top of the boards of a real arm.

    Boards are polled: a missing reply is detected immediately, boards need not publish, and the
    rate of the arm is set here.
    """

    arm: GenericArm
    control: ArmControl
    last_refusal: str = ""

    def initialize(self) -> None:
        """Read the description; `compute` connects to the boards when they are available."""
        params = self.params
        proxies = {
            "board": self.board_proxy,
            "board2": self.board2_proxy,
            "board3": self.board3_proxy,
        }
        part = load_arm_part(params.description, params.part, self.config_file)
        for proxy in proxies.values():
            proxy.set_timeout(params.patience / 1000)
        boards = create_boards(part, proxies)
        self.log.info("%s: %s", params.part, boards)
        self.arm = GenericArm(part)
        begin = StartAction(params.begin, params.begin_speed, params.compliant)
        self.control = ArmControl(self.arm, boards, self.clock, begin)
        self.did_set_speed(1.0)
        self.did_set_hold(0.0)
        self.did_set_push_hold(0.0)
        self.did_set_period(0)

    def did_set_speed(self, _old: float) -> None:
        """Set the share of the speed limits that commands may use."""
        self.arm.speed_limits = self.arm.part.speed_limits * self.params.speed

    def did_set_hold(self, _old: float) -> None:
        """Set how long later commands last."""
        self.control.hold = self.params.hold

    def did_set_push_hold(self, _old: float) -> None:
        """Set how long later torques last."""
        self.control.push_hold = self.params.push_hold

    def did_set_period(self, _old: int) -> None:
        """Set the rate of reading and publishing."""
        self.set_period(self.params.period)

    def compute(self) -> None:
        """Read the arm, renew the current command, publish the state."""
        warning = self.control.update()
        if warning:
            self.log.warning("%s", warning)
        self.genericarmstate_proxy.armState(state_to_message(self.arm, moving=self.control.moving))

    def emergency(self) -> None:
        """Without a clock no motion can be supervised: stop, and hold the arm again later."""
        if self.clock.is_stale:
            self.stop_if_reachable()
            self.control.lose(CLOCK_LOST)

    def finalize(self) -> None:
        """Stop the arm."""
        if hasattr(self, "control"):  # missing after an invalid description
            self.stop_if_reachable()

    def stop_if_reachable(self) -> None:
        """Stop the arm if it is reachable."""
        if not self.control.trouble:
            try:
                self.control.stop()
            except ARM_ERRORS as error:
                self.log.info("the arm could not be stopped: %s", error)

    @contextmanager
    def declared_errors(self) -> Iterator[None]:
        """Raise errors as the exceptions that the interface declares."""
        if self.control.trouble:
            raise NotPossible(f"the arm does not answer: {self.control.trouble}")
        try:
            yield
        except errors.Unreachable as error:
            raise Unreachable(str(error), error.distance, error.angle) from None
        except MiddlewareError as error:
            raise NotPossible(f"the arm does not answer: {error}") from None
        except (*ARM_ERRORS, CommandSuperseded) as error:
            raise NotPossible(str(error)) from None

    @contextmanager
    def log_refusals(self, command: str) -> Iterator[None]:
        """Log errors of commands, whose callers receive no reply."""
        try:
            with self.declared_errors():
                yield
        except NotPossible as error:
            if error.what != self.last_refusal:  # log each reason of a command stream once
                self.log.warning("`%s` is not carried out: %s", command, error.what)
            self.last_refusal = error.what
        else:
            self.last_refusal = ""

    def outcome(self, commands: JointCommands) -> Outcome:
        """Send commands; returns what was clipped or dropped."""
        return Outcome(self.control.carry_out(commands), commands.dropped)

    # implements RoboCompGenericArm::GenericArm

    def GenericArm_getState(self) -> ArmState:
        """The state of the arm."""
        with self.declared_errors():
            return state_to_message(self.arm, moving=self.control.moving)

    def GenericArm_getLimits(self) -> ArmLimits:
        """The limits, and which joints exist."""
        return limits_to_message(self.arm)

    def GenericArm_getChain(self) -> Chain:
        """The kinematic chain in generic angles."""
        try:
            return chain_to_message(self.arm.chain)
        except errors.NoChain as error:
            raise NotPossible(str(error)) from None

    def GenericArm_getHand(self) -> Pose:
        """The pose of the end effector."""
        with self.declared_errors():
            return pose_to_message(self.arm.end_effector_pose())

    def GenericArm_move(self, position: Angles, speed: Angles) -> Outcome:
        """Move to angles, at these mean speeds or, if empty, as fast as the limits allow."""
        with self.declared_errors():
            return self.outcome(self.arm.position_move(position, optional_speed(speed)))

    def GenericArm_moveBy(self, way: Angles, speed: Angles) -> Outcome:
        """Move by these angles from the current ones."""
        with self.declared_errors():
            return self.outcome(self.arm.relative_move(way, optional_speed(speed)))

    def GenericArm_reach(self, x: float, y: float, z: float) -> Outcome:
        """Move the end effector to a point."""
        with self.declared_errors():
            return self.outcome(self.arm.reach(np.array([x, y, z])))

    def GenericArm_reachPose(self, pose: Pose) -> Outcome:
        """Move the end effector to a pose."""
        with self.declared_errors():
            return self.outcome(self.arm.reach(position_of(pose), rotation_of(pose)))

    def GenericArm_follow(self, position: Angles) -> None:
        """Set these angles immediately; for streams of small steps."""
        with self.log_refusals("follow"):
            self.outcome(self.arm.set_position(position))

    def GenericArm_drive(self, velocity: Angles) -> None:
        """Move at these joint velocities until the next command."""
        with self.log_refusals("drive"):
            self.outcome(self.arm.velocity_move(velocity))

    def GenericArm_push(self, torque: Angles) -> None:
        """Apply these torques; they expire unless they are renewed."""
        with self.log_refusals("push"):
            self.outcome(self.arm.set_torque(torque))

    def GenericArm_glide(self, vx: float, vy: float, vz: float) -> None:
        """Move the end effector at this velocity until the next command."""
        with self.log_refusals("glide"):
            velocity = np.array([vx, vy, vz])
            self.control.carry_out(self.arm.line_move(velocity), velocity)

    def GenericArm_setStiffness(self, stiffness: Angles, damping: Angles) -> None:
        """Make the arm compliant; two empty sequences make it stiff."""
        with self.declared_errors():
            self.control.soften(stiffness, damping)

    def GenericArm_stop(self) -> None:
        """Stop every motion."""
        with self.declared_errors():
            self.control.stop()


def optional_speed(speed: Angles) -> Floats | None:
    """The speeds, or None for an empty sequence."""
    return speed if len(speed) else None
