"""Serves the interface `ComponentConnections` of a component. In: a runner. Out: handlers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from robocomp_dsl.runtime.component.connection_report import ConnectionReport
from robocomp_dsl.runtime.component.rewiring import Rewiring
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.component.wiring import Wiring
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts
from robocomp_dsl.runtime.connection.connections_interface import ConnectionInfo


class WiredRunner(Protocol):
    """What the servant needs of a runner."""

    wiring: Wiring
    ports: ComponentPorts
    statistics: Statistics


class ConnectionsServant:
    """The connections of one component."""

    def __init__(self, runner: WiredRunner) -> None:
        self._runner = runner
        self._report = ConnectionReport(runner.wiring, runner.ports, runner.statistics)
        self._rewiring = Rewiring(runner.wiring, lambda: runner.ports)

    def handlers(self) -> Mapping[str, Any]:
        """Handlers by operation name."""
        return {
            "getConnections": self.get_connections,
            "setQos": self._rewiring.set_qos,
            "connect": self._rewiring.connect,
            "disconnect": self._rewiring.disconnect,
            "remap": self._rewiring.remap,
        }

    def get_connections(self) -> list[ConnectionInfo]:
        """All connections."""
        monitors = getattr(self._runner, "monitors", None)
        return self._report.connections(monitors.statuses() if monitors else ())
