"""Through what a component reports to the supervisor of its process.

A component that is alone in its process reports to systemd or rcdeploy itself; one of a group in
one process reports to the group.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.component.sd_notify import SystemdNotifier
from robocomp_dsl.runtime.component.supervisor_pipe import SupervisorPipe


class StateNotifier(Protocol):
    """Receives lifecycle states and pings.

    `watchdog_s`: the supervisor expects a ping at least so often; 0.0: it expects none.
    """

    watchdog_s: float

    def state_changed(self, state: str, reason: str = "") -> None:
        """Report a lifecycle state and its reason."""

    def ping(self) -> None:
        """Report that the component does not hang."""


class HangNotifier(Protocol):
    """Receives heartbeats and hangs."""

    def beat(self, seconds: float) -> None:
        """Report that the next heartbeat follows within `seconds`; 0: none follows."""

    def report(self, report: HangReport) -> None:
        """Report a hang."""


class Supervision(NamedTuple):
    """Both; `in_group`: other components are in the process."""

    states: StateNotifier
    hangs: HangNotifier
    in_group: bool = False


def own_supervision() -> Supervision:
    """That of a component that is alone in its process."""
    return Supervision(SystemdNotifier(), SupervisorPipe())
