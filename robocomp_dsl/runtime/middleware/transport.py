"""Protocols of the transport plane: all that a middleware must implement.

A transport carries values between two ports. It discovers nobody, takes no callback group, counts
no calls and logs no failure of user code: the presence and connection planes do that for every
middleware. A transport has its own codec; nobody else looks into a `Payload`.

Failures of calls are exceptions of `robocomp_dsl.runtime.errors`, and `ServerLost`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.presence.port_record import PortRecord

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component.shown_parameters import ShownParameters
    from robocomp_dsl.runtime.connection.endpoint import Endpoint
    from robocomp_dsl.runtime.connection.incoming_port import IncomingPort

Payload: TypeAlias = Any
"""What travels: bytes, an object of a foreign library, or the values themselves."""


class ServerLost(NoServer):
    """The connection to the server broke before a reply arrived, or `cancel` was called."""


@dataclass(frozen=True, slots=True)
class TransportContext:
    """The component that a transport serves.

    `folder` is a private folder of this middleware in the domain, for its sockets; it is created on
    first use by `open_folder` of `presence.domain_folder`. `addresses` are the addresses that the
    user chose for own ports, by port name. `settings` are further settings of this middleware.
    `fail` ends the component as failed, with a reason: a transport calls it when a thread dies.
    `house` is the open presence, for the transport that shares its connection. `parameters` are
    those of the component, for transports whose tools show and change them; None for a client.
    """

    component: str
    domain: str
    folder: Path
    fail: Callable[[str], None]
    addresses: dict[str, str] = field(default_factory=dict)
    settings: dict[str, str] = field(default_factory=dict)
    house: Any = None
    parameters: ShownParameters | None = None


class BoundOperation(NamedTuple):
    """An operation of one connection, ready to be called.

    `encode` converts the tuple of arguments, while the caller holds its callback group; it raises
    `EncodeError`. None: the tuple itself is the payload. `send` sends a payload without the
    callback group. Of a query, `send(payload)` returns the result of the operation; of a command it
    returns None; of a publication it is `send(payload, number)`, where `number` are the 16 bytes of
    `SEQUENCE_FORMAT`, or empty without `sequence_numbers`.
    """

    encode: Callable[[tuple[Any, ...]], Payload] | None
    send: Callable[..., Any]


class PortServer(Protocol):
    """A served port. `address` goes into its record."""

    address: str

    def close(self) -> None:
        """Accept no further calls; running handlers may finish."""


class ServiceClient(Protocol):
    """A connection to one server."""

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """A call of `operation`; it adds to `bytes_in` and `bytes_out` of `counts`.

        A call raises the declared exceptions of the operation, `RemoteError`, `Timeout`,
        `InterfaceMismatch`, `MalformedMessage`, and `ServerLost`.
        """

    def set_timeout(self, seconds: float) -> None:
        """Limit the calls of operations that are bound from now on."""

    def cancel(self) -> None:
        """End all calls that wait and all later calls with `ServerLost`; called from any thread."""

    def close(self) -> None:
        """Release the connection."""


class Publisher(Protocol):
    """A published port. `address` goes into its record."""

    address: str

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """A publication of `operation`; it adds to `bytes_out` and `drops` of `counts`."""

    def attach(self, subscriber: PortRecord) -> None:
        """Send to `subscriber` from now on (`attaches_subscribers`); never blocks."""

    def detach(self, subscriber: PortRecord) -> None:
        """Send no longer to `subscriber`."""

    def has_subscribers(self) -> bool | None:
        """Whether a publication has a receiver; None: only the presence knows."""

    def close(self) -> None:
        """End the port."""


class Subscription(Protocol):
    """A subscribed port. `address` goes into its record."""

    address: str

    def close(self) -> None:
        """Receive no more messages; running handlers may finish."""


class Transport(Protocol):
    """All connections of one component over one middleware."""

    def serve(self, port: IncomingPort) -> PortServer:
        """Serve a port: pass requests and commands to its operations."""

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> ServiceClient:
        """Connect a required port to a server; `timeout` in s limits each call."""

    def advertise(self, at: Endpoint) -> Publisher:
        """Publish a topic."""

    def subscribe(self, port: IncomingPort) -> Subscription:
        """Receive the publications for a port from `port.at.peers`, or from all if empty."""

    def close(self) -> None:
        """Close all ports and connections."""
