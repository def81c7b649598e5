"""Whose time a simulated world lives by: its own, that of its deployment, or it makes that itself.

In: a world that can be advanced, and the clock of the component that serves it. Out: one `Pace`,
through which time is held, hurried, and begun anew.
"""

from __future__ import annotations

from robocomp_dsl.hardware.pace.follows_time import FollowsTime
from robocomp_dsl.hardware.pace.makes_time import MakesTime
from robocomp_dsl.hardware.pace.own import OwnPace
from robocomp_dsl.hardware.pace.pace import Pace, Paced
from robocomp_dsl.runtime.clock import Clock, WallClock
from robocomp_dsl.runtime.clock_source import ClockSource

__all__ = ["Pace", "Paced", "pace_for"]


def pace_for(world: Paced, clock: Clock | None, speed: float) -> Pace:
    """How a world lives in a component with this clock. Raises `CommandRefused`."""
    if isinstance(clock, ClockSource):
        return MakesTime(world, clock, speed)
    if clock is None or isinstance(clock, WallClock):
        return OwnPace(world, speed)
    return FollowsTime(world, clock)
