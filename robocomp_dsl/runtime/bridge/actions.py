"""One action of a bridge: goals become commands, states become feedback and results.

In: messages of the topics of the action and of its states, and calls of `tick`. Out: messages of
the status, feedback and result, and commands. The messages are those of actionlib; whatever goes
wrong with a goal aborts it, with the reason, and the bridge continues.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import Any

from robocomp_dsl.runtime.bridge.context import NANOSECONDS, MessageContext
from robocomp_dsl.runtime.bridge.counts import BridgeCounts, LossReport
from robocomp_dsl.runtime.bridge.failures import MessageFailure, describe_failure
from robocomp_dsl.runtime.bridge.goals import ActionGoal, ActionGoals, GoalState
from robocomp_dsl.runtime.bridge.hubs import ReceivedMessage
from robocomp_dsl.runtime.bridge.spec import ActionSpec, ActionTopicSpec, CommandSpec

STATUS_RATE = 5.0
"""Hz; the rate at which clients expect the status."""


class ActionInput:
    """Passes the messages of an input to an action; to the input it is a hub without outputs."""

    def __init__(self, take: Callable[[Any], None]) -> None:
        self._take = take

    def add(self, _index: int, message: ReceivedMessage) -> bool:
        """Take a message."""
        self._take(message.value)
        return False


class BridgedAction:
    """The action server; `publish` has the publishing functions by port.

    `now` is the component's clock in s, `now_ns` the instant that messages contain.
    """

    def __init__(
        self,
        spec: ActionSpec,
        worker: object,
        publish: Mapping[str, Callable[..., None]],
        context: MessageContext,
        losses: LossReport,
        log: logging.Logger,
        now: Callable[[], float],
        now_ns: Callable[[], int],
    ) -> None:
        self.spec = spec
        self.counts: BridgeCounts = losses.counts
        self.goals = ActionGoals(now, self._report_end, spec.timeout)
        self._worker = worker
        self._publish = publish
        self._context = context
        self._losses = losses
        self._log = log
        self._now_ns = now_ns
        self._states: dict[str, Any] = {}
        self._goal_count = 0
        self._entry_type = type(spec.result.message().status)

    def connections(self) -> dict[str, ActionInput]:
        """What takes the messages of each input, by its name."""
        takers: dict[str, Callable[[Any], None]] = {
            self.spec.goal: self.accept,
            self.spec.cancel: self.cancel,
        }
        takers |= {name: self._taker(name) for name in self.spec.states}
        return {name: ActionInput(take) for name, take in takers.items()}

    def _taker(self, state: str) -> Callable[[Any], None]:
        return lambda value: self.update(state, value)

    def accept(self, message: Any) -> None:
        """Take a goal: preempt the running one and send the commands."""
        self.counts.messages += 1
        stamp = message.goal_id.stamp
        stamp_ns = stamp.sec * NANOSECONDS + stamp.nanosec or self._now_ns()
        self._goal_count += 1
        goal_id = message.goal_id.id or f"{self.spec.name}-{self._goal_count}-{stamp_ns}"
        goal = self.goals.offer(goal_id, stamp_ns, message.goal)
        if goal is not None:
            # Only states that arrive after the commands tell what these have done.
            self._states.clear()
            failure = self._send_commands(goal, is_on_cancel=False)
            if failure is not None:
                self._end(GoalState.ABORTED, f"{failure.text} ({failure.place})")
        self._publish_status()

    def cancel(self, message: Any) -> None:
        """Take a request to cancel goals."""
        stamp = message.stamp
        goal = self.goals.cancel(message.id, stamp.sec * NANOSECONDS + stamp.nanosec)
        if goal is not None:
            self._stop(goal, GoalState.PREEMPTED, "cancelled")

    def update(self, state: str, value: Any) -> None:
        """Take the message of a state: publish feedback, and end the goal if it is reached."""
        goal = self.goals.running
        if goal is None:
            return
        self._states[state] = value
        if len(self._states) < len(self.spec.states):
            return
        spec = self.spec
        try:
            feedback = self._build(spec.build_feedback, goal)
            self._send_part(spec.feedback, goal, feedback=feedback)
            aborts = spec.aborts is not None and self._build(spec.aborts, goal)
            succeeds = not aborts and self._build(spec.succeeds, goal)
        except Exception as error:
            failure = self._lose(error)
            self._stop(goal, GoalState.ABORTED, f"{failure.text} ({failure.place})")
            return
        if aborts:
            self._end(GoalState.ABORTED, "a condition to abort is true")
        elif succeeds:
            self._end(GoalState.SUCCEEDED)

    def tick(self) -> None:
        """Abort a goal that takes too long, and publish the status; called at `STATUS_RATE`."""
        goal = self.goals.running
        if goal is not None and self.goals.has_expired():
            text = f"not reached within {self.spec.timeout:g} s"
            self._stop(goal, GoalState.ABORTED, text)
        else:
            self._publish_status()

    def _stop(self, goal: ActionGoal, state: GoalState, text: str) -> None:
        """End the running goal, and send the commands that stop it."""
        failure = self._send_commands(goal, is_on_cancel=True)
        if failure is not None:
            text = f"{text}; the command to stop failed: {failure.text} ({failure.place})"
        self._end(state, text)

    def _end(self, state: GoalState, text: str = "") -> None:
        self.goals.end(state, text)
        self._publish_status()

    def _report_end(self, goal: ActionGoal) -> None:
        """Publish the result of a goal that ended; it has defaults if no state has arrived."""
        if goal.state in (GoalState.ABORTED, GoalState.REJECTED):
            self._losses.lose_output(goal.state.name.lower(), goal.text, self.spec.place)
        else:
            self._log.debug("action `%s`: %s %s", self.spec.name, goal.id, goal.state.name.lower())
        spec = self.spec
        is_current = goal.state is not GoalState.RECALLED
        try:
            if is_current and len(self._states) == len(spec.states):
                self._send_part(spec.result, goal, result=self._build(spec.build_result, goal))
                return
        except Exception as error:
            failure = self._lose(error)
            goal.text = "; ".join(filter(None, (goal.text, failure.text)))
        try:
            self._send_part(spec.result, goal)
        except Exception as error:
            self._lose(error)

    def _send_commands(self, goal: ActionGoal, *, is_on_cancel: bool) -> MessageFailure | None:
        """Send the commands of an event in order; returns why one of them could not be sent."""
        for command in self.spec.commands:
            if command.is_on_cancel is is_on_cancel:
                failure = self._send_command(command, goal)
                if failure is not None:
                    return failure
        return None

    def _send_command(self, command: CommandSpec, goal: ActionGoal) -> MessageFailure | None:
        self._begin()
        try:
            self._publish[command.port](*command.build(self._context, self._worker, goal.value))
        except Exception as error:
            return self._lose(error, command.places)
        return None

    def _begin(self) -> None:
        self._context.begin(self._now_ns(), self.counts.messages)

    def _build(self, function: Callable[..., Any], goal: ActionGoal) -> Any:
        self._begin()
        states = [self._states[name] for name in self.spec.states]
        return function(self._context, self._worker, goal.value, *states)

    def _lose(self, error: Exception, places: Mapping[str, str] | None = None) -> MessageFailure:
        found = self.spec.places if places is None else places
        failure = describe_failure(error, self._context.field, found)
        self._losses.lose_output(failure.reason, failure.text, failure.place)
        return failure

    def _send_part(self, topic: ActionTopicSpec, goal: ActionGoal, **parts: Any) -> None:
        message = topic.message()
        message.header.stamp = self._time(message.header.stamp, self._now_ns())
        message.status = self._entry(goal)
        for name, value in parts.items():
            setattr(message, name, value)
        self._publish[topic.port](message)

    def _publish_status(self) -> None:
        topic = self.spec.status
        message = topic.message()
        message.header.stamp = self._time(message.header.stamp, self._now_ns())
        message.status_list = [self._entry(goal) for goal in self.goals.known()]
        try:
            self._publish[topic.port](message)
        except Exception as error:
            self._lose(error)

    def _entry(self, goal: ActionGoal) -> Any:
        """The `actionlib_msgs/GoalStatus` of a goal."""
        entry = self._entry_type()
        entry.goal_id.id = goal.id
        entry.goal_id.stamp = self._time(entry.goal_id.stamp, goal.stamp_ns)
        entry.status = int(goal.state)
        entry.text = goal.text
        return entry

    @staticmethod
    def _time(default: Any, nanoseconds: int) -> Any:
        """An instant as a time of the same type as `default`."""
        seconds, rest = divmod(nanoseconds, NANOSECONDS)
        return type(default)(sec=seconds, nanosec=rest)
