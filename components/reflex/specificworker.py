"""reflex: a touched arm moves away, stays there for a while, and comes back.

In: frames of the skin, states of the arm, the time. Out: commands to the arm, events. What leads
from one state to another is in reflex.smdsl, how far the arm goes in `robocomp_dsl.tactile.reflex`.
"""

from __future__ import annotations

from math import inf

import numpy as np
from generated.interfaces import ArmState, Frame, ReflexState
from lookout import Lookout
from wire import event, pose

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.part_file import arm_part
from robocomp_dsl.tactile.errors import RejectedFrame
from robocomp_dsl.tactile.reflex.law import Response
from robocomp_dsl.tactile.reflex.sense import Sense
from robocomp_dsl.tactile.reflex.withdrawal import (
    Withdrawal,
    furthest,
    lasts,
    news,
    standing,
    stronger,
)


class SpecificWorker(Lookout):
    """Withdraws an arm from touches; `machine` says what it is doing."""

    withdrawal: Withdrawal | None = None
    told_state = ReflexState.Frozen

    def initialize(self) -> None:
        """Read the fields."""
        part = arm_part(self.params.description, self.params.part, self.config_file)
        self.part, self.size = part.name, len(part.servos)
        self.sense = Sense(part.name, part.fields, self.law(), self.params.reach)
        self.pose = self.goal = np.zeros(self.size)
        self.touched = self.since = -inf
        self.until = inf
        super().initialize()

    def finalize(self) -> None:
        """Leave no arm moving."""
        if self.machine.is_in("Withdrawing") or self.machine.is_in("Returning"):
            reason = self.tried(self.genericarm_proxy.stop)
            if reason:
                self.log.info("the arm could not be stopped: %s", reason)

    # The states of reflex.smdsl; compute and what else has to do with `Frozen` is in lookout.py.

    def on_enter_Frozen(self) -> None:
        """Stop; the arm may take its time to answer."""
        self._tell(ReflexState.Frozen)
        self.let_go()

    def state_Frozen(self) -> None:
        """Until `emergency` finds what was missing."""

    def on_enter_Watching(self) -> None:
        """The arm is where it belongs, or as far as it comes."""
        self.away = False
        self._tell(ReflexState.Watching)

    def state_Watching(self) -> None:
        """Until a frame brings a touch."""

    def on_enter_Withdrawing(self) -> None:
        """Away, and further away if it is on its way already."""
        self.away = True
        if self.withdrawal is not None:
            self._move(self.withdrawal.goal, self.params.withdraw_speed)
        self._tell(ReflexState.Withdrawing)

    def state_Withdrawing(self) -> None:
        """Until the arm is there."""
        self._arrive()

    def on_enter_Holding(self) -> None:
        """Wait from now on."""
        self.since = self.clock.now()
        self._tell(ReflexState.Holding)

    def state_Holding(self) -> None:
        """Until the arm has not been touched for a while."""
        if self.clock.now() - max(self.touched, self.since) >= self.params.hold:
            self.machine.go("released")

    def on_enter_Returning(self) -> None:
        """Back to the start pose, slowly."""
        if self.arm is not None:
            self._move(self.arm.within(self.arm.start, self.pose), self.params.return_speed)
        self._tell(ReflexState.Returning)

    def state_Returning(self) -> None:
        """Until the arm is there."""
        self._arrive()

    # subscribesTo RoboCompSkin::SkinFrame

    def SkinFrame_frame(self, frame: Frame) -> None:
        """A new frame: withdraw where fields answer."""
        if self.sense.geometry is None:
            return  # it has just begun, and cannot judge frames
        now, forces = self.clock.now(), np.asarray(frame.force, dtype=np.float64)
        try:
            found = self.sense.feel(frame.sequence, frame.time, frame.geometry, forces)
        except RejectedFrame as rejected:
            self.presence.fault = rejected.fault.value
            if self.sense.gate.rejected[rejected.fault] == 1:
                self.log.warning("such frames are not used, and counted: %s", rejected)
            return
        self.presence.hear_frame(now)
        if found and self.params.enabled:
            self.touched = now
            self._answer(found, frame.time, now)

    # subscribesTo RoboCompGenericArm::GenericArmState

    def GenericArmState_armState(self, state: ArmState) -> None:
        """A new state."""
        found = pose(state, self.size)
        if found is not None:
            self.pose, self.presence.arm = found, self.clock.now()

    # What the states are made of.

    def _answer(self, found: list[Response], time: float, now: float) -> None:
        """Begin a withdrawal, or add to the one that is going on; tell what was answered."""
        before, arm = self._present(now), self.arm
        if before is None or arm is None:
            return
        after = stronger(before, found, arm)
        if furthest(after.goal, before.goal) < self.params.least_change:
            return
        self.withdrawals += before is not self.withdrawal
        self.withdrawal = after
        self.machine.go("touched")
        for one in news(before, after):
            self.reflexevents_proxy.reflex(event(one, self.part, time))

    def _present(self, now: float) -> Withdrawal | None:
        """The withdrawal that a touch adds to; None: to none, and none may begin."""
        last = self.withdrawal
        silent = self.presence.is_silent(now, self.params.arm_timeout)
        if silent or self.machine.is_in("Frozen"):
            return None
        if last is None or now - last.began >= self.params.refractory:
            return standing(self.pose, now)
        going_on = self.machine.is_in("Withdrawing") or self.machine.is_in("Holding")
        return last if going_on else None

    def _move(self, goal: Floats, share: float) -> None:
        """Command the arm; where it refuses, or is silent, freeze."""
        assert self.arm is not None  # noqa: S101 - only `Frozen` is without
        speed = share * self.arm.speed
        self.goal = goal
        self.until = self.clock.now() + lasts(self.pose, goal, speed) + self.params.patience
        reason = self.tried(lambda: self.genericarm_proxy.move(goal, speed))
        if reason:
            self.freeze(f"the arm does not move: {reason}")

    def _arrive(self) -> None:
        """Go on where the arm is there, or does not come any further."""
        there = furthest(self.pose, self.goal) <= self.params.arrived
        if there or self.clock.now() >= self.until:
            self.machine.go("arrived")

    def _tell(self, state: ReflexState) -> None:
        if state != self.told_state:
            self.told_state = state
            self.reflexevents_proxy.stateChanged(state)

    def begin_anew(self) -> None:
        """See `Lookout`."""
        super().begin_anew()
        self.withdrawal, self.touched = None, -inf
