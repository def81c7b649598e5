"""Advances a world with the clock of a deployment whose clock source is another component.

In: a world and the clock of its component. Out: a world that catches up with the clock in every
period of its component.
"""

from __future__ import annotations

from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.simulation.stepping.pausable import Pausable
from robocomp_dsl.simulation.stepping.step_driver import Steppable


class ClockFollower(Pausable):
    """Follows a clock source in another component: the world catches up in every period."""

    speed = 1.0

    def __init__(self, world: Steppable, clock: Clock) -> None:
        super().__init__(world)
        self._clock = clock
        self._epoch = max(clock.reset_count, 0)
        self._at = clock.now()

    @property
    def real_time_factor(self) -> float:
        """See `StepDriver`."""
        tick = getattr(self._clock, "latest_tick", None)
        return float(tick.realTimeFactor) if tick and not self.paused else 0.0

    def validate_speed(self, speed: float) -> str:
        """See `StepDriver`."""
        return (
            "" if speed == self.speed else "another component is the clock source of the deployment"
        )

    def set_speed(self, speed: float) -> None:
        """See `StepDriver`."""
        if why := self.validate_speed(speed):
            raise CommandRefused(why)

    def on_reset(self, seconds: float) -> None:
        """Nothing to do: the clock of the deployment is not reset."""

    def update(self) -> None:
        """Advance the world to the time of the clock; reset it if the clock was reset."""
        with self._world.lock:
            now, epoch = self._clock.now(), self._clock.reset_count
            if epoch != self._epoch:
                self._world.reset_state()
                self._epoch, self._at = epoch, now
            passed, self._at = now - self._at, now
            if not (self.paused or self._world.failure):
                self._world.advance(passed)
        self._world.dispatch_events()

    def start(self) -> None:
        """Nothing to do: the clock runs in another component."""

    def stop(self) -> None:
        """Nothing to do: the clock runs in another component."""
