"""The goals of an action server as of actionlib's `SimpleActionServer`: one runs, the newest one.

In: goals, cancel requests and the outcome of the running goal. Out: the goal to start or to stop,
and each goal that ends. No I/O, no threads; time is that of a function.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

KEEP_S = 5.0
"""How long an ended goal is part of the status."""
MAX_GOALS = 100
"""More ended goals, and more cancelled goals that never arrived, are forgotten earlier."""


class GoalState(IntEnum):
    """The numbers of `actionlib_msgs/GoalStatus`."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    PREEMPTING = 6
    RECALLING = 7
    RECALLED = 8
    LOST = 9


@dataclass(slots=True, eq=False)
class ActionGoal:
    """A goal of a client: `value` is its message, `began` and `ended` are in s on the clock."""

    id: str
    stamp_ns: int
    value: Any
    began: float
    state: GoalState = GoalState.PENDING
    text: str = ""
    ended: float | None = None


class ActionGoals:
    """The goals that clients know of.

    `now` is a clock in s. `ended` is called with each goal that ends, before another one begins.
    `timeout` in s, 0: none.
    """

    def __init__(
        self, now: Callable[[], float], ended: Callable[[ActionGoal], None], timeout: float = 0.0
    ) -> None:
        self.running: ActionGoal | None = None
        self.timeout = timeout
        self._now = now
        self._ended = ended
        self._goals: OrderedDict[str, ActionGoal] = OrderedDict()
        self._cancelled: OrderedDict[str, None] = OrderedDict()
        self._cancelled_until_ns = -1

    def offer(self, goal_id: str, stamp_ns: int, value: Any) -> ActionGoal | None:
        """A new goal; returns it if it is to be started now.

        It preempts the running goal, unless it is older. A goal that was cancelled before it
        arrived is recalled. A known id is ignored: the client repeats itself.
        """
        if goal_id in self._goals:
            return None
        goal = ActionGoal(goal_id, stamp_ns, value, self._now())
        self._goals[goal_id] = goal
        if goal_id in self._cancelled or stamp_ns <= self._cancelled_until_ns:
            self._cancelled.pop(goal_id, None)
            self._end(goal, GoalState.RECALLED, "cancelled before it was accepted")
            return None
        if self.running is not None and stamp_ns < self.running.stamp_ns:
            self._end(goal, GoalState.RECALLED, "a newer goal is running")
            return None
        if self.running is not None:
            self.end(GoalState.PREEMPTED, "preempted by a new goal")
        goal.state = GoalState.ACTIVE
        self.running = goal
        return goal

    def cancel(self, goal_id: str, stamp_ns: int) -> ActionGoal | None:
        """A request to cancel; returns the running goal if it is to be stopped.

        An id alone cancels this goal, a stamp [ns] all goals up to it, neither of them all goals.
        """
        self._cancelled_until_ns = max(self._cancelled_until_ns, stamp_ns or -1)
        if goal_id and goal_id not in self._goals:
            self._cancelled[goal_id] = None
            while len(self._cancelled) > MAX_GOALS:
                self._cancelled.popitem(last=False)
        goal = self.running
        if goal is None:
            return None
        is_every = not goal_id and not stamp_ns
        is_meant = is_every or goal.id == goal_id or 0 < goal.stamp_ns <= stamp_ns
        return goal if is_meant else None

    def end(self, state: GoalState, text: str = "") -> None:
        """End the running goal."""
        goal = self.running
        if goal is not None:
            self.running = None
            self._end(goal, state, text)

    def _end(self, goal: ActionGoal, state: GoalState, text: str) -> None:
        goal.state, goal.text, goal.ended = state, text, self._now()
        self._ended(goal)

    def has_expired(self) -> bool:
        """Whether the running goal takes longer than the timeout."""
        goal = self.running
        if goal is None or not self.timeout:
            return False
        now = self._now()
        goal.began = min(goal.began, now)  # a simulated clock may be set back
        return now - goal.began >= self.timeout

    def known(self) -> list[ActionGoal]:
        """The goals of the status: the running one, and those that ended recently."""
        now = self._now()
        ended = [goal for goal in self._goals.values() if goal.ended is not None]
        for goal in ended[: max(len(ended) - MAX_GOALS, 0)]:
            del self._goals[goal.id]
        for goal in ended:
            # A clock that is set back, as a simulated one, ends nothing earlier or later.
            if goal.ended is not None and not 0 <= now - goal.ended <= KEEP_S:
                self._goals.pop(goal.id, None)
        return list(self._goals.values())
