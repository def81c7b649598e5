"""A world by the clock of the machine: who has had a turn does not wait for the end of a slice."""

from __future__ import annotations

import threading
import time

import pytest

from robocomp_dsl.hardware.servants.fair_lock import FairLock
from robocomp_dsl.simulation.stepping import real_time

DEADLINE = 60.0


class World:
    """It counts its steps, and tells what had been asked for when one was made."""

    failure = ""
    dt = 0.001

    def __init__(self) -> None:
        self.lock = FairLock()
        self.asked = self.done = 0
        self._pending = self.time = 0.0

    @property
    def time_to_next_step(self) -> float:
        return self.dt - self._pending

    def advance(self, seconds: float) -> None:
        self._pending += seconds
        steps = int(self._pending / self.dt + 1e-9)
        self._pending -= steps * self.dt
        self.time += steps * self.dt
        if steps:
            self.done = self.asked

    def reset_state(self) -> None: ...

    def dispatch_events(self) -> None: ...


def test_real_time_driver_steps_after_command_without_running_ahead(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(real_time, "SLICE_S", 2 * DEADLINE)
    monkeypatch.setattr(real_time, "MAX_CATCH_UP_S", 2 * DEADLINE)
    world = World()
    pace = real_time.RealTimeDriver(world, 1.0)
    start = time.perf_counter()
    pace.start()
    try:
        for command in range(1, 50):
            with world.lock:
                assert world.time <= time.perf_counter() - start + 2 * world.dt
                world.asked = command
            until = time.monotonic() + DEADLINE
            while world.done < command:
                assert time.monotonic() < until, f"command {command} waits for the end of its slice"
                time.sleep(0.0001)
    finally:
        ending = threading.Thread(target=pace.stop)
        ending.start()
        while ending.is_alive():
            with world.lock:  # a rest as long as this test's ends only so
                pass
            ending.join(0.01)


def test_fair_lock_wakes_worker_once_per_visit() -> None:
    turns = FairLock()
    assert not turns.wait_for_visitor(0.0)
    for _ in range(3):
        with turns:
            pass
    assert turns.wait_for_visitor(DEADLINE)
    assert not turns.wait_for_visitor(0.0)
    with turns.reader:
        pass
    assert not turns.wait_for_visitor(0.0)
    with turns:
        pass
    with turns.worker_turn():
        pass  # which has seen what was done in the turn before
    assert not turns.wait_for_visitor(0.0)


def test_fair_lock_wakes_worker_for_late_visitor() -> None:
    turns, inside = FairLock(), threading.Event()

    def come() -> None:
        inside.set()
        with turns:
            pass

    with turns.worker_turn():
        other = threading.Thread(target=come)
        other.start()
        assert inside.wait(DEADLINE)
    assert turns.wait_for_visitor(DEADLINE)
    other.join()
