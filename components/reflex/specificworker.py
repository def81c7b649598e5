"""reflex: a touched arm moves away, stays there for a while, and returns.

In: frames of the skin, states of the arm, the time. Out: commands to the arm, events. The state
machine is in reflex.smdsl, the size of the motion comes from `robocomp_dsl.tactile.reflex`.
"""

from __future__ import annotations

from math import inf

import numpy as np
from body import RobotBody, load_kinematics
from health_monitor import HealthMonitor
from messages import cause_to_message, event, limitation, pose
from obstacle import ObstacleMonitor
from reflex_generated.interfaces import ArmState, Frame, LimitCause, ReflexState

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.part_file import load_arm
from robocomp_dsl.tactile.errors import RejectedFrame
from robocomp_dsl.tactile.reflex.law import Response
from robocomp_dsl.tactile.reflex.perception import ReflexPerception
from robocomp_dsl.tactile.reflex.receptive_fields import Ignored
from robocomp_dsl.tactile.reflex.return_path import ReturnPath
from robocomp_dsl.tactile.reflex.withdrawal import (
    Withdrawal,
    duration,
    initial,
    max_joint_distance,
    new_responses,
    synchronised,
)


class SpecificWorker(HealthMonitor):
    """Withdraws an arm from touches; `machine` holds the current state."""

    withdrawal: Withdrawal | None = None
    published_state = ReflexState.Frozen

    def initialize(self) -> None:
        """Read the fields."""
        robot, part = load_arm(self.params.description, self.params.part, self.config_file)
        self.part, self.size = part.name, len(part.servos)
        self.sense = ReflexPerception(part.name, part.fields, self.force_law(), self.params.reach)
        kinematics = load_kinematics(robot, part.name)
        self.body = RobotBody(kinematics, self.params.law, self.params.clearance)
        if kinematics is None and self.params.law == "pose":
            self.log.warning("the description has no `model` in MJCF or URDF: the law is `fixed`")
        self.obstacle, self.reported = ObstacleMonitor(), (-inf, "")
        self.return_path, self.is_last_goal = ReturnPath(), True
        self.pose = self.goal = np.zeros(self.size)
        self.touched = self.since = -inf
        self.until = inf
        super().initialize()

    def finalize(self) -> None:
        """Stop the arm."""
        if self.machine.is_in("Withdrawing") or self.machine.is_in("Returning"):
            reason = self.failure_of(self.genericarm_proxy.stop)
            if reason:
                self.log.info("the arm could not be stopped: %s", reason)

    # The states of reflex.smdsl; compute and the recovery from `Frozen` are in health_monitor.py.

    def on_enter_Frozen(self) -> None:
        """Stop the arm; its reply may be late."""
        self._publish_state(ReflexState.Frozen)
        self.release_arm()

    def state_Frozen(self) -> None:
        """Wait until `emergency` reports recovery."""

    def on_enter_Watching(self) -> None:
        """The arm has returned, as far as possible."""
        if self.away:
            self.obstacle.returned = self.clock.now()
        self.away = False
        self.return_path.clear()
        self._publish_state(ReflexState.Watching)

    def state_Watching(self) -> None:
        """Wait for a touch."""

    def on_enter_Withdrawing(self) -> None:
        """Move away; a moving arm moves further away."""
        self.away = True
        if self.withdrawal is not None:
            self.return_path.add(self.pose)
            self._move(self.withdrawal.goal, self.params.withdraw_speed)
        self._publish_state(ReflexState.Withdrawing)

    def state_Withdrawing(self) -> None:
        """Wait until the arm has arrived."""
        self._arrive()

    def on_enter_Holding(self) -> None:
        """Start the hold time."""
        self.since = self.clock.now()
        self._publish_state(ReflexState.Holding)

    def state_Holding(self) -> None:
        """Wait until the arm has not been touched for the hold time, longer with an obstacle."""
        pause = self.obstacle.pause(self.params.hold, self.params.longest_pause)
        if self.clock.now() - max(self.touched, self.since) >= pause:
            self.machine.send("released")

    def on_enter_Returning(self) -> None:
        """Return slowly to the start pose."""
        self._return()
        self._publish_state(ReflexState.Returning)

    def state_Returning(self) -> None:
        """Wait until the arm has arrived; it may return by several goals."""
        if self._is_at_goal() and not self.is_last_goal:
            self._return()
        else:
            self._arrive()

    # subscribesTo RoboCompSkin::SkinFrame

    def SkinFrame_frame(self, frame: Frame) -> None:
        """Process a frame: withdraw if a field responds."""
        if self.sense.geometry is None:
            return  # without the geometry frames cannot be validated
        now, forces = self.clock.now(), np.asarray(frame.force, dtype=np.float64)
        try:
            responses = self.sense.process_frame(
                frame.sequence, frame.time, frame.geometry, forces, self._self_contacts()
            )
        except RejectedFrame as rejected:
            self.heartbeats.fault = rejected.fault.value
            if self.sense.validator.rejected[rejected.fault] == 1:
                self.log.warning("frame rejected; further ones are only counted: %s", rejected)
            return
        self.heartbeats.on_frame(now)
        if responses and self.params.enabled:
            self.touched = now
            self.obstacle.on_touch(now, is_returning=self.machine.is_in("Returning"))
            self._withdraw(responses, frame.time, now)

    # subscribesTo RoboCompGenericArm::GenericArmState

    def GenericArmState_armState(self, state: ArmState) -> None:
        """Store the angles of the arm."""
        angles = pose(state, self.size)
        if angles is not None:
            self.pose, self.heartbeats.arm = angles, self.clock.now()

    # Actions of the states.

    def _withdraw(self, responses: list[Response], time: float, now: float) -> None:
        """Start a withdrawal or extend the current one; publish the responses."""
        before, arm = self._current_withdrawal(now), self.arm
        if before is None or arm is None:
            return
        after = self.body.law.extend(before, responses, self.pose, arm)
        if after is before:
            return
        self._report_limit(after, responses[0], time)
        if max_joint_distance(after.goal, before.goal) < self.params.least_change:
            if after.limit is not None:
                self.withdrawal = after  # planned once, although the arm cannot move
            return
        if before is not self.withdrawal or not self._has_moved(before):
            self.withdrawals += 1
            self._record_obstacle(responses[0], time)
        self.withdrawal = after
        self.machine.send("touched")
        for response in new_responses(before, after):
            motion = self.body.law.motion(response, after, self.pose)
            self.reflexevents_proxy.reflex(event(response, motion, self.part, time))

    def _current_withdrawal(self, now: float) -> Withdrawal | None:
        """The withdrawal that a touch extends; None if none may start now."""
        last = self.withdrawal
        silent = self.heartbeats.is_silent(now, self.params.arm_timeout)
        if silent or self.machine.is_in("Frozen"):
            return None
        if last is None or now - last.began >= self.params.refractory:
            return initial(self.pose, now)
        in_progress = self.machine.is_in("Withdrawing") or self.machine.is_in("Holding")
        return last if in_progress or not self._has_moved(last) else None

    def _has_moved(self, withdrawal: Withdrawal) -> bool:
        return max_joint_distance(withdrawal.goal, withdrawal.origin) >= self.params.least_change

    def _self_contacts(self) -> Ignored | None:
        """Whether a touch is a contact of the robot with itself, at the current pose."""
        if self.body.self_contacts is None:
            return None
        self.body.self_contacts.at(self.pose)
        return self.body.self_contacts.includes

    def _report_limit(self, withdrawal: Withdrawal, response: Response, time: float) -> None:
        """Publish and log what makes the withdrawal smaller; each cause once per withdrawal."""
        limit = withdrawal.limit
        if limit is None or self.reported == (withdrawal.began, limit.name):
            return
        self.reported = (withdrawal.began, limit.name)
        field = response.field.name
        self.log.warning("withdrawal from `%s` limited: %s", field, limit.value)
        self.reflexevents_proxy.limited(limitation(cause_to_message(limit), field, time))

    def _record_obstacle(self, response: Response, time: float) -> None:
        """Wait longer before the next return if an obstacle has stayed."""
        if not self.obstacle.on_withdrawal():
            return
        field = response.field.name
        pause = self.obstacle.pause(self.params.hold, self.params.longest_pause)
        self.log.warning("an obstacle stays at `%s`; the arm returns after %.3g s", field, pause)
        self.reflexevents_proxy.limited(limitation(LimitCause.Obstacle, field, time, pause))

    def _move(self, goal: Floats, share: float) -> None:
        """Command the arm; freeze if it rejects the command or does not reply."""
        assert self.arm is not None  # noqa: S101 - only `Frozen` has no arm
        speed = synchronised(self.pose, goal, share * self.arm.speed)
        self.goal = goal
        self.until = self.clock.now() + duration(self.pose, goal, speed) + self.params.patience
        reason = self.failure_of(lambda: self.genericarm_proxy.move(goal, speed))
        if reason:
            self.freeze(f"the arm does not move: {reason}")

    def _return(self) -> None:
        """Move to the start pose, or to the next goal on a way that is free of the own body."""
        if self.arm is None:
            return
        start = self.arm.within(self.arm.start, self.pose)
        goal = self.return_path.next_goal(self.pose, start, self.body.directions)
        self.is_last_goal = goal is None or goal is start
        if goal is None:
            self.log.warning("the arm stays: every way back would press it against the robot")
            goal = self.pose
        self._move(goal, self.params.return_speed)

    def _is_at_goal(self) -> bool:
        return max_joint_distance(self.pose, self.goal) <= self.params.arrived

    def _arrive(self) -> None:
        """Leave the state when the arm has arrived, or makes no progress."""
        if self._is_at_goal() or self.clock.now() >= self.until:
            self.machine.send("arrived")

    def _publish_state(self, state: ReflexState) -> None:
        if state != self.published_state:
            self.published_state = state
            self.reflexevents_proxy.stateChanged(state)

    def on_time_reset(self) -> None:
        """Also discard the withdrawal."""
        super().on_time_reset()
        self.withdrawal, self.touched = None, -inf
        self.obstacle, self.reported = ObstacleMonitor(), (-inf, "")
