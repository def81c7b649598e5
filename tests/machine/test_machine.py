"""The run-time state machine: transitions, methods and timers."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.machine import (
    Machine,
    UnknownEvent,
)
from tests.machine.machine_samples import GAME, ManualClock, Worker, build_machine


def test_machine_follows_transitions(worker: Worker, clock: ManualClock) -> None:
    machine = build_machine(GAME, worker, clock)
    assert machine.states == ("waiting",)
    assert machine.send("start") is True
    assert machine.states == ("playing", "music", "loud", "moves")
    assert machine.send("start") is False, "nobody waits for it here"
    assert machine.send("hush") is True
    assert machine.states == ("playing", "music", "soft", "moves")
    assert machine.is_in("music")
    assert not machine.is_in("loud")
    assert machine.send("pause") is True
    assert machine.states == ("paused",)
    entered = [s for s in worker.calls if s.startswith("on_enter")]
    assert entered[:2] == ["on_enter_waiting", "on_enter_playing"]
    assert worker.calls.index("on_exit_waiting") < worker.calls.index("on_enter_playing")
    assert worker.calls[-1] == "on_enter_paused"


def test_machine_calls_methods_of_active_states(worker: Worker, clock: ManualClock) -> None:
    machine = build_machine(GAME, worker, clock)
    machine.send("start")
    worker.calls.clear()
    machine.tick()
    assert worker.calls == ["state_playing", "state_music", "state_loud", "state_moves"]


def test_machine_does_not_call_state_that_is_left(clock: ManualClock) -> None:
    called = []

    class Leaving:
        def state_playing(self) -> None:
            called.append("playing")
            machine.send("pause")

        def state_moves(self) -> None:
            called.append("moves")

        def state_paused(self) -> None:
            called.append("paused")

    machine = build_machine(GAME, Leaving(), clock)
    machine.send("start")
    machine.tick()
    assert called == ["playing"]


def test_machine_takes_timed_transitions(worker: Worker, clock: ManualClock) -> None:
    machine = build_machine(GAME, worker, clock)
    assert machine.next_due() is None
    machine.send("start")
    assert machine.next_due() == 60.0
    clock.moment = 59.9
    machine.fire_due()
    assert machine.is_in("playing")
    clock.moment = 60.0
    machine.fire_due()
    assert machine.states == ("paused",)
    assert machine.next_due() == 70.0
    machine.send("start")
    assert machine.next_due() == 120.0, "a state that is entered again waits from the beginning"
    clock.moment = 130.0
    machine.fire_due()
    clock.moment = 140.0
    machine.fire_due()
    assert machine.ended
    assert machine.next_due() is None


def test_machine_handles_events_of_methods_afterwards(clock: ManualClock) -> None:
    seen: list[tuple[str, ...]] = []

    class Eager:
        def on_enter_waiting(self) -> None:
            machine.send("start")

        def on_enter_playing(self) -> None:
            machine.send("pause")
            seen.append(machine.states)

    machine = Machine(GAME, Eager(), clock, lambda: None)
    machine.start()
    assert machine.states == ("paused",)
    assert seen
    assert "paused" not in seen[0]


def test_machine_failures_reach_caller(clock: ManualClock) -> None:
    class Failing:
        def on_enter_playing(self) -> None:
            raise ZeroDivisionError

    machine = build_machine(GAME, Failing(), clock)
    assert machine.next_due() is None
    with pytest.raises(ZeroDivisionError):
        machine.send("start")
    assert machine.states == ("waiting",)
    assert machine.next_due() is None


def test_machine_reports_unknown_names(worker: Worker, clock: ManualClock) -> None:
    machine = Machine(GAME, worker, clock, lambda: None)
    with pytest.raises(UnknownEvent, match="starts after `initialize`"):
        machine.send("start")
    machine.start()
    with pytest.raises(UnknownEvent, match="unknown event `strat`; did you mean `start`"):
        machine.send("strat")
    with pytest.raises(UnknownEvent, match="unknown state `pausd`; did you mean `paused`"):
        machine.is_in("pausd")


def test_machine_notifies_observers(worker: Worker, clock: ManualClock) -> None:
    changes: list[int] = []
    machine = Machine(GAME, worker, clock, lambda: changes.append(1))
    machine.start()
    assert not changes
    machine.send("start")
    assert changes
