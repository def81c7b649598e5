"""Protocol through which the supervisor learns the lifecycle state of components.

A component is ready when it is alive in the domain and its lifecycle has reached `compute`. A
monitor reports every change when it happens; there is no polling.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

from robocomp_dsl.deploy.status import SimulatedTime

READY_STATES = ("compute", "emergency")
"""Lifecycle states in which a component counts as ready."""

StateCallback: TypeAlias = Callable[[str, int, str], None]
"""`on_state_changed(name, pid, state)`: process `pid` reports component `name` in `state`. An empty
state: the component is no longer alive. Called from any thread."""


class LifecycleMonitor(Protocol):
    """Monitors the components of one domain."""

    def start(self, on_state_changed: StateCallback) -> None:
        """Start monitoring. Reports the components that are already alive first."""

    def simulated_time(self) -> SimulatedTime | None:
        """The latest simulated time; None without a simulated clock."""

    def close(self) -> None:
        """Stop monitoring; no callback follows."""
