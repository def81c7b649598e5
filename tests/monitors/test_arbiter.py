"""Events with lifetimes, and the arbiter that selects one connection from them."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.monitors.constraint import parse_constraint
from robocomp_dsl.runtime.connection.arbiter import Arbiter
from robocomp_dsl.runtime.connection.event_container import EventContainer
from tests.monitors.manual_clock import ManualClock
from tests.monitors.test_constraint import NAMES, TEXTS, python_value

TIMES = st.integers(1, 8).map(lambda quarters: quarters / 4)  # exact in binary
SETTING = st.tuples(st.just("set"), st.sampled_from(NAMES), st.none() | TIMES)
UNSETTING = st.tuples(st.just("unset"), st.sampled_from(NAMES), st.none())
PASSING = st.tuples(st.just("wait"), st.just(""), TIMES)
ACTIONS = st.lists(SETTING | UNSETTING | PASSING, max_size=30)


class ExpectedEvents:
    """A model of the events: the expiry of each, in quarters of a second."""

    def __init__(self) -> None:
        self.now = 0.0
        self.expiries: dict[str, float] = {}

    def act(self, action: str, event: str, seconds: float | None) -> None:
        if action == "set":
            self.expiries[event] = math.inf if seconds is None else self.now + seconds
        elif action == "unset":
            self.expiries.pop(event, None)
        else:
            self.now += seconds or 0.0

    @property
    def active(self) -> frozenset[str]:
        return frozenset(event for event, expiry in self.expiries.items() if self.now < expiry)


def act(
    events: EventContainer, clock: ManualClock, action: str, event: str, s: float | None
) -> None:
    """Do an action with the real container."""
    if action == "set":
        events.set(event, s)
    elif action == "unset":
        events.unset(event)
    else:
        clock.time += s or 0.0


@given(ACTIONS)
def test_event_container_expires_events_exactly(
    actions: list[tuple[str, str, float | None]],
) -> None:
    clock, expected = ManualClock(), ExpectedEvents()
    events = EventContainer(clock)
    for action in actions:
        act(events, clock, *action)
        expected.act(*action)
        assert events.active() == expected.active
        assert {event for event, left in events.remaining() if left > 0} == expected.active


@given(st.lists(TEXTS, min_size=1, max_size=4), ACTIONS)
def test_arbiter_has_at_most_one_winner_the_first_whose_constraint_is_true(
    texts: list[str], actions: list[tuple[str, str, float | None]]
) -> None:
    clock, expected = ManualClock(), ExpectedEvents()
    events = EventContainer(clock)
    reports: list[str] = []
    constraints = {f"c{i}.P": parse_constraint(text) for i, text in enumerate(texts)}
    arbiter = Arbiter(constraints, events, reports.append)
    conflicts = set()
    for action in actions:
        act(events, clock, *action)
        expected.act(*action)
        true = [f"c{i}.P" for i, t in enumerate(texts) if python_value(t, expected.active)]
        assert arbiter.winner() == (true[0] if true else "")
        conflicts |= {(true[0], other) for other in true[1:]}
    assert len(reports) == len(conflicts)
    for winner, loser in conflicts:
        assert any(r.startswith(f"{winner} and {loser} may both") for r in reports)


def test_arbiter_reports_a_conflict_with_its_events_once() -> None:
    events = EventContainer(ManualClock())
    reports: list[str] = []
    constraints = {"a.P": parse_constraint("e_face"), "b.P": parse_constraint("e_face or e_hand")}
    arbiter = Arbiter(constraints, events, reports.append)
    events.set("e_face")
    assert [arbiter.winner() for _ in range(3)] == ["a.P"] * 3
    assert reports == [
        "a.P and b.P may both pass messages with the events e_face: `when e_face` and"
        " `when e_face or e_hand` are true; a.P wins, because the deployment declares it first"
    ]


def test_event_container_forgets_lifetimes_when_time_is_reset() -> None:
    clock = ManualClock()
    events = EventContainer(clock)
    clock.time = 100.0
    events.set("e_timed", 5.0)
    events.set("e_permanent")
    clock.time, clock.reset_count = 0.0, 1
    assert events.active() == {"e_permanent"}


@pytest.mark.parametrize(
    ("event", "lifetime"),
    [("e face", 1.0), ("", 1.0), (3, 1.0), ("e", 0), ("e", -1.0), ("e", math.nan), ("e", "2")],
)
def test_event_container_rejects_names_and_lifetimes(event: str, lifetime: float) -> None:
    events = EventContainer(ManualClock())
    with pytest.raises(ValueError, match=r"not the name of an event|a time above 0 s"):
        events.set(event, lifetime)
    assert not events.active()
