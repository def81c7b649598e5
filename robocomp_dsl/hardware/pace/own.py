"""A world that lives by the clock of the machine: it advances in a thread of its own.

In: a world and a wished speed. Out: time that passes, and how fast it does. When somebody has had a
turn at the world, with a command maybe, it makes its next step at once: it may be one step ahead.
"""

from __future__ import annotations

import math
import threading
import time

from robocomp_dsl.hardware.errors import Diverged
from robocomp_dsl.hardware.pace.held import Held
from robocomp_dsl.hardware.pace.pace import Paced

SLICE = 0.002
"""Seconds of the wall clock from turn to turn of the physics."""

MOST_BEHIND = 0.1
"""Seconds of the wall clock that it makes up for; behind a longer pause the machine was asleep."""


class OwnPace(Held):
    """By the clock of the machine, in a thread of its own."""

    def __init__(self, world: Paced, speed: float) -> None:
        super().__init__(world)
        self.speed = speed
        self.factor = 0.0
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None

    def refusal(self, speed: float) -> str:
        """See `Pace`."""
        return "" if speed >= 0 else "a speed cannot be negative"

    def set_speed(self, speed: float) -> None:
        """See `Pace`."""
        self.speed = speed

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
        last, owed, hurried = time.perf_counter(), 0.0, False
        while not self._stopping.is_set():
            begun = time.perf_counter()
            owed, last = min(owed + begun - last, MOST_BEHIND), begun
            with self._world.turns.at_work():
                seconds = self._due(owed, hurried=hurried)
                passed = self._slice(seconds)
            owed, hurried = owed - seconds, False
            self._world.tell()
            if self.paused or self._world.failure:
                self._stopping.wait(SLICE)
            elif self.speed and owed < SLICE:
                hurried = self._rest(begun - owed)
            self._measure(passed, time.perf_counter() - begun)

    def _due(self, owed: float, *, hurried: bool) -> float:
        """Seconds of the wall clock to live in one turn; where it is `hurried`, a step at least."""
        usual = min(max(owed, 0.0), SLICE)
        return max(usual, self._world.left / self.speed) if hurried and self.speed else usual

    def _rest(self, since: float) -> bool:
        """Until a slice after `since`; or, where somebody had a turn, no longer than to `since`.

        Tells whether that was so.
        """
        called = self._world.turns.rest(since + SLICE - time.perf_counter())
        if called and (ahead := since - time.perf_counter()) > 0.0:
            time.sleep(ahead)  # never for nothing: that alone would let all other threads go first
        return called

    def _slice(self, seconds: float) -> float:
        """So many seconds of the wall clock; the simulated seconds that have passed."""
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
