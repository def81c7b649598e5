"""The goals of an action server: which goal runs, and how each of them ends."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.bridge.goals import KEEP_S, MAX_GOALS, ActionGoal, ActionGoals, GoalState


class GoalRecord:
    """Goals on a clock that the test sets; `ended` has id, state and text of each ended goal."""

    def __init__(self, timeout: float = 0.0) -> None:
        self.time = 100.0
        self.ended: list[tuple[str, GoalState, str]] = []
        self.goals = ActionGoals(lambda: self.time, self._end, timeout)

    def _end(self, goal: ActionGoal) -> None:
        self.ended.append((goal.id, goal.state, goal.text))

    def states(self) -> dict[str, GoalState]:
        return {goal.id: goal.state for goal in self.goals.known()}


def test_action_goals_start_first_goal() -> None:
    record = GoalRecord()
    goal = record.goals.offer("a", 5, "value")
    assert goal is not None
    assert (goal.state, goal.value, record.goals.running) == (GoalState.ACTIVE, "value", goal)
    assert not record.ended


def test_action_goals_preempt_running_goal_by_newer_one() -> None:
    record = GoalRecord()
    record.goals.offer("a", 5, 1)
    assert record.goals.offer("b", 5, 2) is record.goals.running
    assert record.ended == [("a", GoalState.PREEMPTED, "preempted by a new goal")]
    assert record.states() == {"a": GoalState.PREEMPTED, "b": GoalState.ACTIVE}


def test_action_goals_recall_goal_that_is_older_than_running_one() -> None:
    record = GoalRecord()
    record.goals.offer("a", 5, 1)
    assert record.goals.offer("b", 4, 2) is None
    assert record.ended == [("b", GoalState.RECALLED, "a newer goal is running")]


def test_action_goals_ignore_known_id() -> None:
    record = GoalRecord()
    record.goals.offer("a", 5, 1)
    assert record.goals.offer("a", 6, 2) is None
    assert not record.ended


@pytest.mark.parametrize(
    ("goal_id", "stamp_ns", "is_stopped"),
    [("a", 0, True), ("", 0, True), ("", 5, True), ("", 4, False), ("x", 0, False)],
)
def test_action_goals_cancel_by_id_stamp_or_all(
    goal_id: str, stamp_ns: int, *, is_stopped: bool
) -> None:
    record = GoalRecord()
    goal = record.goals.offer("a", 5, 1)
    assert record.goals.cancel(goal_id, stamp_ns) is (goal if is_stopped else None)
    assert not record.ended


@pytest.mark.parametrize(("goal_id", "stamp_ns"), [("a", 0), ("", 7)])
def test_action_goals_recall_goal_that_was_cancelled_before(goal_id: str, stamp_ns: int) -> None:
    record = GoalRecord()
    assert record.goals.cancel(goal_id, stamp_ns) is None
    assert record.goals.offer("a", 7, 1) is None
    assert record.ended == [("a", GoalState.RECALLED, "cancelled before it was accepted")]
    assert record.goals.offer("b", 8, 1) is record.goals.running


def test_action_goals_end_running_goal_once() -> None:
    record = GoalRecord()
    record.goals.offer("a", 5, 1)
    record.goals.end(GoalState.SUCCEEDED, "there")
    record.goals.end(GoalState.ABORTED)
    assert record.ended == [("a", GoalState.SUCCEEDED, "there")]
    assert record.goals.running is None


def test_action_goals_expire_after_timeout_also_if_clock_is_set_back() -> None:
    record = GoalRecord(timeout=2.0)
    assert not record.goals.has_expired()
    record.goals.offer("a", 5, 1)
    record.time = 101.9
    assert not record.goals.has_expired()
    record.time = 10.0
    assert not record.goals.has_expired()
    record.time = 12.0
    assert record.goals.has_expired()


def test_action_goals_forget_ended_goals() -> None:
    record = GoalRecord()
    record.goals.offer("a", 5, 1)
    record.goals.end(GoalState.SUCCEEDED)
    record.time += KEEP_S
    assert record.states() == {"a": GoalState.SUCCEEDED}
    record.time += 0.1
    assert not record.states()
    for number in range(2 * MAX_GOALS):
        record.goals.offer(f"{number}", 6, 1)
        record.goals.cancel(f"never {number}", 0)
    assert len(record.states()) == MAX_GOALS + 1
    assert len(record.goals._cancelled) == MAX_GOALS
