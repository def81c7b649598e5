"""A component of ours whose ports are on Ice, defined in a few lines."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.presence.port_record import PortRecord


class IceComponent:
    """One component of ours whose ports are on Ice."""

    def __init__(self, name: str, domain: str, **options: Any) -> None:
        self.name = name
        self.statistics = Statistics()
        self.group = CallbackGroup()
        self.context = ComponentContext(name, domain, self.group, self.statistics, **options)
        self.ports: ComponentPorts = open_ports("ice", self.context)

    def endpoint(self, interface: Any, *external: str, qos: Qos | None = None) -> Endpoint:
        """The port of an interface; `external` are addresses of plain programs."""
        port = interface.name.rpartition("::")[2]
        records = tuple(
            PortRecord("server", interface.name, "plain", port, "", "ice", address)
            for address in external
        )
        middlewares = ("ice",)
        return Endpoint(interface, self.name, port, (), qos or Qos(), middlewares, records)

    def serve(self, interface: Any, handlers: dict[str, Callable[..., Any]]) -> None:
        every = {o.name: handlers.get(o.name, lambda *_: None) for o in interface.operations}
        self.ports.serve(self.endpoint(interface), every, self.group)

    def subscribe(
        self, interface: Any, handler: Callable[..., Any], *external: str, **options: Any
    ) -> None:
        handlers = {operation.name: handler for operation in interface.operations}
        self.ports.subscribe(self.endpoint(interface, *external, **options), handlers, self.group)
