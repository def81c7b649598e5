"""State machines: the way through the states, time, and what the worker's methods see."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

import pytest

from robocomp_dsl.runtime.machine import (
    Machine,
    MachineSpec,
    StateSpec,
    TransitionSpec,
    UnknownEvent,
)

GAME = MachineSpec(
    "game",
    (
        StateSpec("waiting", initial=True),
        StateSpec(
            "playing",
            parallel=True,
            inside=(
                StateSpec("music", inside=(StateSpec("loud", initial=True), StateSpec("soft"))),
                StateSpec("moves"),
            ),
        ),
        StateSpec("paused"),
        StateSpec("over", final=True),
    ),
    (
        TransitionSpec("waiting", "playing", "start"),
        TransitionSpec("loud", "soft", "hush"),
        TransitionSpec("playing", "paused", "pause", after=60.0),
        TransitionSpec("paused", "playing", "start"),
        TransitionSpec("paused", "over", after=10.0),
    ),
)


@dataclass
class HandClock:
    """A clock that a test turns."""

    moment: float = 0.0

    def now(self) -> float:
        return self.moment

    def wait_until(self, moment: float | None, wake: threading.Event) -> None:
        raise NotImplementedError


@dataclass
class Worker:
    """Writes down what is called."""

    calls: list[str] = field(default_factory=list)
    machine: Machine | None = None

    def __getattr__(self, name: str) -> object:
        if name.startswith(("state_", "on_enter_", "on_exit_")):
            return lambda: self.calls.append(name)
        raise AttributeError(name)


@pytest.fixture
def clock() -> HandClock:
    return HandClock()


@pytest.fixture
def worker() -> Worker:
    return Worker()


def build_machine(spec: MachineSpec, worker: object, clock: HandClock) -> Machine:
    machine = Machine(spec, worker, clock, lambda: None)
    machine.start()
    return machine


def test_machine_follows_transitions(worker: Worker, clock: HandClock) -> None:
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


def test_machine_calls_methods_of_active_states(worker: Worker, clock: HandClock) -> None:
    machine = build_machine(GAME, worker, clock)
    machine.send("start")
    worker.calls.clear()
    machine.tick()
    assert worker.calls == ["state_playing", "state_music", "state_loud", "state_moves"]


def test_machine_does_not_call_state_that_is_left(clock: HandClock) -> None:
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


def test_machine_takes_timed_transitions(worker: Worker, clock: HandClock) -> None:
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


def test_machine_handles_events_of_methods_afterwards(clock: HandClock) -> None:
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


def test_machine_failures_reach_caller(clock: HandClock) -> None:
    class Failing:
        def on_enter_playing(self) -> None:
            raise ZeroDivisionError

    machine = build_machine(GAME, Failing(), clock)
    assert machine.next_due() is None
    with pytest.raises(ZeroDivisionError):
        machine.send("start")
    assert machine.states == ("waiting",)
    assert machine.next_due() is None


def test_machine_reports_unknown_names(worker: Worker, clock: HandClock) -> None:
    machine = Machine(GAME, worker, clock, lambda: None)
    with pytest.raises(UnknownEvent, match="starts after `initialize`"):
        machine.send("start")
    machine.start()
    with pytest.raises(UnknownEvent, match="unknown event `strat`; did you mean `start`"):
        machine.send("strat")
    with pytest.raises(UnknownEvent, match="unknown state `pausd`; did you mean `paused`"):
        machine.is_in("pausd")


def test_machine_notifies_observers(worker: Worker, clock: HandClock) -> None:
    changes: list[int] = []
    machine = Machine(GAME, worker, clock, lambda: changes.append(1))
    machine.start()
    assert not changes
    machine.send("start")
    assert changes


def test_machine_loses_no_event_of_many_threads(clock: HandClock) -> None:
    threads, each = 8, 300
    inside: list[int] = []
    most: list[int] = []

    class Counting:
        entered = 0

        def on_enter_a(self) -> None:
            inside.append(1)
            most.append(len(inside))
            self.entered += 1
            inside.pop()

    spec = MachineSpec(
        "counter", (StateSpec("a", initial=True),), (TransitionSpec("a", "a", "again"),)
    )
    worker = Counting()
    machine = build_machine(spec, worker, clock)
    begin = threading.Barrier(threads)

    def fire() -> None:
        begin.wait(60.0)
        for _ in range(each):
            machine.send("again")

    running = [threading.Thread(target=fire) for _ in range(threads)]
    for thread in running:
        thread.start()
    for thread in running:
        thread.join()
    assert worker.entered == 1 + threads * each
    assert max(most) == 1
    assert machine.states == ("a",)


def test_machine_event_does_not_wait_for_running_thread(clock: HandClock) -> None:
    entered, leave = threading.Event(), threading.Event()

    class Slow:
        def on_enter_playing(self) -> None:
            entered.set()
            assert leave.wait(60.0)

    machine = build_machine(GAME, Slow(), clock)
    other = threading.Thread(target=machine.send, args=("start",))
    other.start()
    assert entered.wait(60.0)
    assert machine.send("pause") is False, "it is left to the other thread"
    assert not machine.is_in("paused")
    leave.set()
    other.join()
    assert machine.states == ("paused",)


def test_machine_failure_discards_only_its_own_events(clock: HandClock) -> None:
    entered, leave = threading.Event(), threading.Event()
    failures: list[BaseException] = []

    class Failing:
        def on_enter_playing(self) -> None:
            machine.send("pause")
            entered.set()
            assert leave.wait(60.0)
            raise ZeroDivisionError

        def on_enter_paused(self) -> None:
            raise AssertionError

    machine = build_machine(GAME, Failing(), clock)

    def start() -> None:
        try:
            machine.send("start")
        except ZeroDivisionError as failure:
            failures.append(failure)

    other = threading.Thread(target=start)
    other.start()
    assert entered.wait(60.0)
    assert machine.send("start") is False
    leave.set()
    other.join()
    assert len(failures) == 1, "the second one was logged"
    assert machine.states == ("waiting",)


def test_machine_timer_of_failed_transition_is_due_again(clock: HandClock) -> None:
    class Once:
        failed = False

        def on_enter_paused(self) -> None:
            if not self.failed:
                self.failed = True
                raise ZeroDivisionError

    machine = build_machine(GAME, Once(), clock)
    machine.send("start")
    clock.moment = 61.0
    with pytest.raises(ZeroDivisionError):
        machine.fire_due()
    assert machine.is_in("playing")
    machine.fire_due()
    assert machine.states == ("paused",)
