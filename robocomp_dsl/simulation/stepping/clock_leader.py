"""Advances a world together with the clock of its deployment, whose source is this component.

In: a world and the clock source of its component. Out: a world that is at the time of the clock at
every tick.
"""

from __future__ import annotations

import threading

from robocomp_dsl.hardware.devices.errors import CommandRefused, Diverged
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.simulation.stepping.step_driver import Steppable

STEP_TIMEOUT_S = 5.0
"""Time-out of a step [s]."""


class ClockLeader:
    """The world and the clock source advance together: pausing one pauses both."""

    def __init__(self, world: Steppable, clock: ClockSource, speed: float) -> None:
        self._world = world
        self._clock = clock
        self._epoch = clock.current_tick.epoch
        self._at = clock.now()
        self._paused_by_failure = False
        self._stepping = threading.Lock()
        clock.set_speed(speed)

    @property
    def speed(self) -> float:
        """See `StepDriver`."""
        return self._clock.speed

    @property
    def real_time_factor(self) -> float:
        """See `StepDriver`."""
        return self._clock.current_tick.realTimeFactor

    @property
    def paused(self) -> bool:
        """See `StepDriver`."""
        return self._clock.paused

    def validate_speed(self, speed: float) -> str:
        """See `StepDriver`."""
        return "" if speed >= 0 else "a speed cannot be negative"

    def set_speed(self, speed: float) -> None:
        """See `StepDriver`."""
        self._clock.set_speed(speed)

    def pause(self) -> None:
        """See `StepDriver`."""
        self._clock.pause()

    def resume(self) -> None:
        """See `StepDriver`."""
        self._clock.resume()

    def step(self, seconds: float) -> None:
        """See `StepDriver`; other components run meanwhile, when they are due."""
        if not self._stepping.acquire(blocking=False):
            raise CommandRefused("a step is already in progress")
        try:
            self._clock.step(seconds)
            if not self._clock.wait_step_done(STEP_TIMEOUT_S):
                raise CommandRefused(
                    f"step timed out after {STEP_TIMEOUT_S:g} s: a component has not finished its"
                    " cycle (in lock-step, components cannot step the clock themselves)"
                )
        finally:
            self._stepping.release()

    def on_reset(self, seconds: float) -> None:
        """See `StepDriver`."""
        self._clock.reset(seconds)
        self._epoch, self._at = self._clock.current_tick.epoch, seconds
        if self._paused_by_failure:
            self._paused_by_failure = False
            self._clock.resume()

    def update(self) -> None:
        """Dispatch events: the world is already at the current time."""
        self._world.dispatch_events()

    def start(self) -> None:
        """See `StepDriver`."""
        self._clock.set_pre_tick_hook(self._before_tick)

    def stop(self) -> None:
        """Nothing to do: the clock ends with its component."""

    def _before_tick(self, seconds: float, epoch: int) -> None:
        """Advance to the next tick, unless the clock was reset meanwhile."""
        with self._world.lock:
            if self._clock.current_tick.epoch != epoch:
                return
            if epoch != self._epoch:
                # the clock itself was reset
                self._world.reset_state()
                self._epoch, self._at = epoch, 0.0
            passed, self._at = seconds - self._at, seconds
            if not self._world.failure:
                self._advance(passed)

    def _advance(self, passed: float) -> None:
        try:
            self._world.advance(passed)
        except Diverged:
            # no component may continue in a world that has stopped; `reset` resumes time
            self._paused_by_failure = not self._clock.paused
            self._clock.pause()
