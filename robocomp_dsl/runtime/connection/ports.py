"""Protocols of the ports of one component, and of the channels that its proxies use.

`component_ports.ComponentPorts` implements them for every middleware. The conformance suite in
`tests/middleware/` defines the behaviour; failures are those of `robocomp_dsl.runtime.errors`.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.endpoint import Endpoint

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component.shown_parameters import ShownParameters

OperationCallable: TypeAlias = Callable[..., Any]
log = logging.getLogger("robocomp")


@dataclass(frozen=True, slots=True)
class ComponentContext:
    """The component that has the ports. Components of other domains are invisible.

    `listen_port` 0: none. `fail` ends the component as failed, with a reason; a middleware calls it
    when one of its threads dies. `addresses` are chosen by the user: of middleware and port;
    `transport_settings` by middleware and key. `unique_name`: opening fails with
    `MiddlewareError` if another process runs a component of this name in the domain; clients share
    names. `call_hook(name, *arguments)` calls a hook of the user's class for an event of a
    connection; None: there is no such class. `parameters` are for the tools of middlewares that
    have parameters.
    """

    component: str
    domain: str
    callback_group: CallbackGroup
    statistics: Statistics
    listen_port: int = 0
    fail: Callable[[str], None] = log.error
    unique_name: bool = False
    addresses: Mapping[tuple[str, str], str] = field(default_factory=dict)
    transport_settings: Mapping[tuple[str, str], str] = field(default_factory=dict)
    call_hook: Callable[..., None] | None = None
    parameters: ShownParameters | None = None


class Channel(Protocol):
    """The calling side of a port, used by a proxy. `timeout` in s limits every call."""

    timeout: float

    def bind(self, operation: Operation) -> OperationCallable:
        """A function that calls `operation`; its arguments are the inputs in order."""

    def wait(self, timeout: float) -> bool:
        """Wait up to `timeout` s for a peer; returns whether there is one."""

    def has_subscribers(self) -> bool:
        """Whether a publication would have a receiver now; cheap, does not wait."""


class Ports(Protocol):
    """All ports of one component."""

    def serve(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """Answer queries and commands with `handlers`, by operation name, under `execution`."""

    def proxy(self, at: Endpoint) -> Channel:
        """A channel to a peer that serves the interface."""

    def advertise(self, at: Endpoint) -> Channel:
        """A channel that publishes to all subscribers."""

    def subscribe(
        self, at: Endpoint, handlers: Mapping[str, OperationCallable], execution: CallbackGroup
    ) -> None:
        """Pass publications to `handlers`, by operation name, in the order of each publisher."""

    def find_servers(self, interface: Interface, timeout: float) -> list[str]:
        """The components that serve `interface`, sorted; waits up to `timeout` s for the first."""

    def publish_state(self, state: str) -> None:
        """Publish the lifecycle state to monitors of the domain; "" before the end."""

    def interrupt(self) -> None:
        """Let waiting calls and all later calls raise immediately."""

    def close(self) -> None:
        """Close all ports; no handler is called afterwards."""
