"""Pauses a world independently of the clock of the deployment."""

from __future__ import annotations

from robocomp_dsl.simulation.stepping.step_driver import Steppable


class Pausable:
    """The part of a `StepDriver` that pauses only the world."""

    def __init__(self, world: Steppable) -> None:
        self._world = world
        self.paused = False

    def pause(self) -> None:
        """Pause the world."""
        with self._world.lock:
            self.paused = True

    def resume(self) -> None:
        """See `StepDriver`."""
        with self._world.lock:
            self.paused = False

    def step(self, seconds: float) -> None:
        """See `StepDriver`."""
        with self._world.lock:
            self._world.advance(seconds)
