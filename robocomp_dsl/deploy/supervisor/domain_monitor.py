"""Monitors the components of a domain, and the simulated time of their clock source.

In: a domain. Out: every state change when it happens; the exit of a process within milliseconds.
"""

from __future__ import annotations

from robocomp_dsl.deploy.status import SimulatedTime
from robocomp_dsl.deploy.supervisor.lifecycle_monitor import StateCallback
from robocomp_dsl.runtime.clock import NANO
from robocomp_dsl.runtime.presence.state_monitor import StateMonitor
from robocomp_dsl.runtime.time.tick_monitor import TickMonitor


class DomainMonitor:
    """A `LifecycleMonitor`. Raises `MiddlewareError` if no session can be opened."""

    def __init__(self, domain: str) -> None:
        self._states = StateMonitor(domain)
        self._ticks = TickMonitor(self._states.session, domain)
        self._time: SimulatedTime | None = None

    def start(self, on_state_changed: StateCallback) -> None:
        """See `LifecycleMonitor`."""
        self._states.start(on_state_changed)

    def simulated_time(self) -> SimulatedTime | None:
        """See `LifecycleMonitor`."""
        if tick := self._ticks.latest():
            factor = tick.realTimeFactor
            self._time = SimulatedTime(tick.time / NANO, factor, tick.epoch, tick.paused)
        return self._time

    def close(self) -> None:
        """See `LifecycleMonitor`."""
        self._states.close()
