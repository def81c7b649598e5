"""A world whose time is that of its deployment: it and the clock of all move as one.

In: a world and the clock source of the component that serves it. Out: a world that is always where
the clock is, at every tick.
"""

from __future__ import annotations

import threading

from robocomp_dsl.hardware.errors import CommandRefused, Diverged
from robocomp_dsl.hardware.pace.pace import Paced
from robocomp_dsl.runtime.clock_source import ClockSource

PATIENCE_S = 5.0
"""How long a step waits for a time that does not move."""


class MakesTime:
    """The time of the deployment is that of this world: whoever holds one holds both."""

    def __init__(self, world: Paced, clock: ClockSource, speed: float) -> None:
        self._world = world
        self._clock = clock
        self._epoch = clock.told.epoch
        self._at = clock.now()
        self._held = False
        self._stepping = threading.Lock()
        clock.set_speed(speed)

    @property
    def speed(self) -> float:
        """See `Pace`."""
        return self._clock.speed

    @property
    def factor(self) -> float:
        """See `Pace`."""
        return self._clock.told.realTimeFactor

    @property
    def paused(self) -> bool:
        """See `Pace`."""
        return self._clock.paused

    def refusal(self, speed: float) -> str:
        """See `Pace`."""
        return "" if speed >= 0 else "a speed cannot be negative"

    def set_speed(self, speed: float) -> None:
        """See `Pace`."""
        self._clock.set_speed(speed)

    def pause(self) -> None:
        """See `Pace`."""
        self._clock.pause()

    def resume(self) -> None:
        """See `Pace`."""
        self._clock.resume()

    def step(self, seconds: float) -> None:
        """See `Pace`: the others compute on the way, when their time comes."""
        if not self._stepping.acquire(blocking=False):
            raise CommandRefused("it makes a step already")
        try:
            self._clock.step(seconds)
            if not self._clock.stepped(PATIENCE_S):
                raise CommandRefused(
                    f"time has not moved for {PATIENCE_S:g} s: somebody is still at work at this"
                    " moment; in lock-step no component of the deployment can step the time"
                )
        finally:
            self._stepping.release()

    def anew(self, seconds: float) -> None:
        """See `Pace`."""
        self._clock.reset(seconds)
        self._epoch, self._at = self._clock.told.epoch, seconds
        if self._held:
            self._held = False
            self._clock.resume()

    def keep_up(self) -> None:
        """It is ahead of all others, and now tells them of what has happened."""
        self._world.tell()

    def start(self) -> None:
        """See `Pace`."""
        self._clock.carry(self._along)

    def stop(self) -> None:
        """The clock ends with its component."""

    def _along(self, seconds: float, epoch: int) -> None:
        """Be where the clock is about to be, unless it has begun anew meanwhile."""
        with self._world.turns:
            if self._clock.told.epoch != epoch:
                return
            if epoch != self._epoch:
                # somebody has reset the clock itself
                self._world.renew()
                self._epoch, self._at = epoch, 0.0
            passed, self._at = seconds - self._at, seconds
            if not self._world.failure:
                self._advance(passed)

    def _advance(self, passed: float) -> None:
        try:
            self._world.advance(passed)
        except Diverged:
            # nobody is to go on in a world that has stopped; `reset` lets time go on
            self._held = not self._clock.paused
            self._clock.pause()
