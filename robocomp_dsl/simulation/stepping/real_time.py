"""Advances a world by the wall clock, in a thread of its own.

In: a world and a requested speed. Out: simulated time, and the real-time factor. After a visitor
has held the lock, perhaps with a command, the next step follows immediately: the world may be one
step ahead.
"""

from __future__ import annotations

import math
import threading
import time

from robocomp_dsl.hardware.devices.errors import Diverged
from robocomp_dsl.simulation.stepping.pausable import Pausable
from robocomp_dsl.simulation.stepping.step_driver import Steppable

SLICE_S = 0.002
"""Wall time between two turns of the physics [s]."""

MAX_CATCH_UP_S = 0.1
"""Maximum delay to catch up with [s]; after a longer one the machine was suspended."""


class RealTimeDriver(Pausable):
    """Steps the world by the wall clock, in its own thread."""

    def __init__(self, world: Steppable, speed: float) -> None:
        super().__init__(world)
        self.speed = speed
        self.real_time_factor = 0.0
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None

    def validate_speed(self, speed: float) -> str:
        """See `StepDriver`."""
        return "" if speed >= 0 else "a speed cannot be negative"

    def set_speed(self, speed: float) -> None:
        """See `StepDriver`."""
        self.speed = speed

    def on_reset(self, seconds: float) -> None:
        """Nothing to do: the only clock is that of the world."""

    def update(self) -> None:
        """Nothing to do: the thread steps the world."""

    def start(self) -> None:
        """See `StepDriver`."""
        self._thread = threading.Thread(target=self._run, name="physics", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """See `StepDriver`."""
        self._stopping.set()
        if self._thread:
            self._thread.join()

    def _run(self) -> None:
        last, owed, hurried = time.perf_counter(), 0.0, False
        while not self._stopping.is_set():
            begun = time.perf_counter()
            owed, last = min(owed + begun - last, MAX_CATCH_UP_S), begun
            with self._world.lock.worker_turn():
                seconds = self._due(owed, hurried=hurried)
                passed = self._advance(seconds)
            owed, hurried = owed - seconds, False
            self._world.dispatch_events()
            if self.paused or self._world.failure:
                self._stopping.wait(SLICE_S)
            elif self.speed and owed < SLICE_S:
                hurried = self._sleep(begun - owed)
            self._measure(passed, time.perf_counter() - begun)

    def _due(self, owed: float, *, hurried: bool) -> float:
        """Wall time to advance in one turn [s]; at least one step if `hurried`."""
        usual = min(max(owed, 0.0), SLICE_S)
        return (
            max(usual, self._world.time_to_next_step / self.speed)
            if hurried and self.speed
            else usual
        )

    def _sleep(self, since: float) -> bool:
        """Sleep until a slice after `since`; only until `since` if a visitor had the lock.

        Returns whether a visitor had it.
        """
        called = self._world.lock.wait_for_visitor(since + SLICE_S - time.perf_counter())
        if called and (ahead := since - time.perf_counter()) > 0.0:
            time.sleep(ahead)  # sleep(0) would yield to all other threads
        return called

    def _advance(self, seconds: float) -> float:
        """Advance by `seconds` of wall time; returns the simulated seconds that passed."""
        world = self._world
        if self.paused or world.failure:
            return 0.0
        before = world.time
        simulated = seconds * self.speed if self.speed else 10 * world.dt
        try:
            world.advance(simulated)
        except Diverged:
            return 0.0
        return max(world.time - before, 0.0)

    def _measure(self, passed: float, took: float) -> None:
        """The real-time factor, smoothed over half a second."""
        weight = 1 - math.exp(-took / 0.5)
        self.real_time_factor += weight * (passed / max(took, 1e-9) - self.real_time_factor)
