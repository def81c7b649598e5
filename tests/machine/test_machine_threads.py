"""Events of several threads and failures of methods in the run-time state machine."""

from __future__ import annotations

import threading

import pytest

from robocomp_dsl.runtime.machine import (
    MachineSpec,
    StateSpec,
    TransitionSpec,
)
from tests.machine.machine_samples import GAME, ManualClock, build_machine


def test_machine_loses_no_event_of_many_threads(clock: ManualClock) -> None:
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


def test_machine_event_does_not_wait_for_running_thread(clock: ManualClock) -> None:
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


def test_machine_failure_discards_only_its_own_events(clock: ManualClock) -> None:
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


def test_machine_timer_of_failed_transition_is_due_again(clock: ManualClock) -> None:
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
