"""A world that can be held by itself, whatever the time of others does."""

from __future__ import annotations

from robocomp_dsl.hardware.pace.pace import Paced


class Held:
    """The part of a `Pace` that holds the world alone."""

    def __init__(self, world: Paced) -> None:
        self._world = world
        self.paused = False

    def pause(self) -> None:
        """Time of the world stands still."""
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
