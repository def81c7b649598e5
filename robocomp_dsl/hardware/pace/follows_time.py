"""A world that goes along with a time that another component makes.

In: a world and the clock of the component that serves it. Out: a world that catches up with the
clock in every period of its component.
"""

from __future__ import annotations

from robocomp_dsl.hardware.errors import CommandRefused
from robocomp_dsl.hardware.pace.held import Held
from robocomp_dsl.hardware.pace.pace import Paced
from robocomp_dsl.runtime.clock import Clock


class FollowsTime(Held):
    """The time of the deployment comes from elsewhere; the world goes along in every period."""

    speed = 1.0

    def __init__(self, world: Paced, clock: Clock) -> None:
        super().__init__(world)
        self._clock = clock
        self._epoch = max(clock.epoch, 0)
        self._at = clock.now()

    @property
    def factor(self) -> float:
        """See `Pace`."""
        told = getattr(self._clock, "told", None)
        return float(told.realTimeFactor) if told and not self.paused else 0.0

    def refusal(self, speed: float) -> str:
        """See `Pace`."""
        return "" if speed == self.speed else "another component makes the time of the deployment"

    def set_speed(self, speed: float) -> None:
        """See `Pace`."""
        if why := self.refusal(speed):
            raise CommandRefused(why)

    def anew(self, seconds: float) -> None:
        """The clock of the deployment goes on as it does."""

    def keep_up(self) -> None:
        """Be where the clock is; where it has begun anew, the world does so too."""
        with self._world.turns:
            now, epoch = self._clock.now(), self._clock.epoch
            if epoch != self._epoch:
                self._world.renew()
                self._epoch, self._at = epoch, now
            passed, self._at = now - self._at, now
            if not (self.paused or self._world.failure):
                self._world.advance(passed)
        self._world.tell()

    def start(self) -> None:
        """The clock runs without it."""

    def stop(self) -> None:
        """The clock runs without it."""
