"""A served port on all its middlewares.

In: the port, which may get another name while it is open. Out: servers that are opened and closed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.port_opener import PortOpener
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.middleware.transport import PortServer
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence


@dataclass(slots=True)
class OpenServer:
    """The port on one middleware."""

    port: IncomingPort
    server: PortServer
    record: PortRecord


class ServingPort:
    """One served port of a component; `at` is the port as it is now."""

    def __init__(
        self,
        ports: PortOpener,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
    ) -> None:
        self.at = at
        self._ports = ports
        self._handlers = handlers
        self._execution = execution
        self._servers: list[OpenServer] = []

    def open(self) -> None:
        """Serve the port."""
        for middleware in self._ports.middlewares(self.at):
            port = self._ports.incoming_port(self.at, self._handlers, self._execution)
            server = self._ports.transport(middleware).serve(port)
            record = self._ports.declare("server", self.at, middleware, server.address)
            self._servers.append(OpenServer(port, server, record))

    def rename(self, at: Endpoint) -> None:
        """Serve the port as `at`; calls that have arrived under the former name are answered."""
        former, self._servers = self._servers, []
        self.at = at
        self.open()
        for opened in former:
            self._ports.presence.withdraw(opened.record)
            opened.server.close()

    def set_thread_priority(self, priority: int | None) -> bool:
        """Change the priority of the receiving threads; returns whether it is in force."""
        results = [opened.port.set_thread_priority(priority) for opened in self._servers]
        return all(results)

    def withdraw(self, presence: Presence) -> None:
        """Make the port unknown, before it is closed."""
        for opened in self._servers:
            presence.withdraw(opened.record)

    def close(self) -> None:
        """Accept no further calls."""
        for opened in self._servers:
            opened.server.close()
