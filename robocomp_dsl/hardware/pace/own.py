"""A world that lives by the clock of the machine: it advances in a thread of its own.

In: a world and a wished speed. Out: time that passes, and how fast it does. Who has had a turn at
the world, with a command maybe, sees it go on as soon as a step is due.
"""

from __future__ import annotations

import math
import threading
import time

from robocomp_dsl.hardware.errors import Diverged
from robocomp_dsl.hardware.pace.pace import Paced

SLICE = 0.002
"""Seconds of the wall clock from turn to turn of the physics."""

MOST_BEHIND = 0.1
"""Seconds of the wall clock that it makes up for; behind a longer pause the machine was asleep."""


class OwnPace:
    """By the clock of the machine, in a thread of its own."""

    def __init__(self, world: Paced, speed: float) -> None:
        self._world = world
        self.speed = speed
        self.paused = False
        self.factor = 0.0
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None

    def refusal(self, speed: float) -> str:
        """See `Pace`."""
        return "" if speed >= 0 else "a speed cannot be negative"

    def set_speed(self, speed: float) -> None:
        """See `Pace`."""
        self.speed = speed

    def pause(self) -> None:
        """See `Pace`."""
        with self._world.turns:
            self.paused = True

    def resume(self) -> None:
        """See `Pace`."""
        with self._world.turns:
            self.paused = False

    def step(self, seconds: float) -> None:
        """See `Pace`."""
        with self._world.turns:
            self._world.advance(seconds)

    def anew(self, seconds: float) -> None:
        """Its only clock is that of the world."""

    def keep_up(self) -> None:
        """It does so by itself."""

    def start(self) -> None:
        """See `Pace`."""
        self._thread = threading.Thread(target=self._live, name="physics", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """See `Pace`."""
        self._stopping.set()
        if self._thread:
            self._thread.join()

    def _live(self) -> None:
        last, owed = time.perf_counter(), 0.0
        while not self._stopping.is_set():
            begun = time.perf_counter()
            owed, last = min(owed + begun - last, MOST_BEHIND), begun
            with self._world.turns.at_work():
                passed = self._slice(min(owed, SLICE))
                due = self._world.left
            self._world.tell()
            owed = max(owed - SLICE, 0.0)
            if self.paused or self._world.failure:
                self._stopping.wait(SLICE)
            elif self.speed and owed < SLICE:
                since = begun - owed
                self._rest(since + SLICE, since + due / self.speed)
            self._measure(passed, time.perf_counter() - begun)

    def _rest(self, end: float, due: float) -> None:
        """Until `end`; or until somebody has had a turn and the next step is `due`."""
        if self._world.turns.rest(end - time.perf_counter()):
            time.sleep(max(min(due, end) - time.perf_counter(), 0.0))

    def _slice(self, seconds: float) -> float:
        """One turn of so many seconds of the wall clock; the simulated seconds that have passed."""
        world = self._world
        if self.paused or world.failure:
            return 0.0
        before = world.time
        wanted = seconds * self.speed if self.speed else 10 * world.dt
        try:
            world.advance(wanted)
        except Diverged:
            return 0.0
        return max(world.time - before, 0.0)

    def _measure(self, passed: float, took: float) -> None:
        """The real-time factor, smoothed over half a second."""
        weight = 1 - math.exp(-took / 0.5)
        self.factor += weight * (passed / max(took, 1e-9) - self.factor)
