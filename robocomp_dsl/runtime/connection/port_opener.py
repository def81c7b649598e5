"""What a port needs of the ports of its component, to open and close what belongs to it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.connection_watch import ConnectionWatch
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.middleware.transport import Transport
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence


class PortOpener(Protocol):
    """See `component_ports.ComponentPorts`."""

    presence: Presence
    watch: ConnectionWatch

    def transport(self, name: str) -> Transport:
        """The transport of a middleware, opened on first use."""

    def incoming_port(
        self,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
        *,
        count_losses: bool = False,
        is_start: bool = True,
    ) -> IncomingPort:
        """A port for a transport."""

    def forget(self, port: IncomingPort) -> None:
        """A port has been closed while the component runs."""

    def middlewares(self, at: Endpoint) -> tuple[str, ...]:
        """The middlewares of a served, published or subscribed port."""

    def declare(self, role: str, at: Endpoint, middleware: str, address: str) -> PortRecord:
        """Make a port known."""
