"""Selects the step driver of a world: real time, or the clock of the deployment.

In: a world that can be advanced, and the clock of the component that serves it. Out: the
`StepDriver`.
"""

from __future__ import annotations

from robocomp_dsl.runtime.clock import Clock, WallClock
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.simulation.stepping.clock_follower import ClockFollower
from robocomp_dsl.simulation.stepping.clock_leader import ClockLeader
from robocomp_dsl.simulation.stepping.real_time import RealTimeDriver
from robocomp_dsl.simulation.stepping.step_driver import StepDriver, Steppable

__all__ = ["StepDriver", "Steppable", "select_driver"]


def select_driver(world: Steppable, clock: Clock | None, speed: float) -> StepDriver:
    """The driver of `world` in a component with this `clock`. Raises `CommandRefused`."""
    if isinstance(clock, ClockSource):
        return ClockLeader(world, clock, speed)
    if clock is None or isinstance(clock, WallClock):
        return RealTimeDriver(world, speed)
    return ClockFollower(world, clock)
