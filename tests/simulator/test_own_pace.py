"""A world by the clock of the machine: who has had a turn does not wait for the end of a slice."""

from __future__ import annotations

import threading
import time

import pytest

from robocomp_dsl.hardware.pace import own
from robocomp_dsl.hardware.turns import Turns

DEADLINE = 60.0


class World:
    """It counts its steps, and tells what had been asked for when one was made."""

    failure = ""
    dt = 0.001

    def __init__(self) -> None:
        self.turns = Turns()
        self.asked = self.done = 0
        self._owed = self.time = 0.0

    @property
    def left(self) -> float:
        return self.dt - self._owed

    def advance(self, seconds: float) -> None:
        self._owed += seconds
        steps = int(self._owed / self.dt + 1e-9)
        self._owed -= steps * self.dt
        self.time += steps * self.dt
        if steps:
            self.done = self.asked

    def renew(self) -> None: ...

    def tell(self) -> None: ...


def test_a_command_has_its_step_at_once_and_time_does_not_run_away(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(own, "SLICE", 2 * DEADLINE)
    monkeypatch.setattr(own, "MOST_BEHIND", 2 * DEADLINE)
    world = World()
    pace = own.OwnPace(world, 1.0)
    start = time.perf_counter()
    pace.start()
    try:
        for command in range(1, 50):
            with world.turns:
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
            with world.turns:  # a rest as long as this test's ends only so
                pass
            ending.join(0.01)


def test_turns_are_told_to_the_worker_once() -> None:
    turns = Turns()
    assert not turns.rest(0.0)
    for _ in range(3):
        with turns:
            pass
    assert turns.rest(DEADLINE)
    assert not turns.rest(0.0)
    with turns.quiet:
        pass
    assert not turns.rest(0.0)
    with turns:
        pass
    with turns.at_work():
        pass  # which has seen what was done in the turn before
    assert not turns.rest(0.0)


def test_whoever_comes_while_it_works_is_not_missed() -> None:
    turns, inside = Turns(), threading.Event()

    def come() -> None:
        inside.set()
        with turns:
            pass

    with turns.at_work():
        other = threading.Thread(target=come)
        other.start()
        assert inside.wait(DEADLINE)
    assert turns.rest(DEADLINE)
    other.join()
