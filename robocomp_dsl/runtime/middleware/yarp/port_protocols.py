"""What a YARP port uses, and what its administrative commands use of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream


class Receiver(Protocol):
    """What takes the messages of a port."""

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        """Handle a message of `size` bytes; returns the reply."""

    def reject(self, error: MalformedMessage) -> Bottle:
        """A message cannot be read; returns the reply."""

    def unwritable(self, error: EncodeError) -> Bottle:
        """A reply cannot be written; returns another."""


class Outputs(Protocol):
    """The outgoing connections of a port."""

    def add(self, name: str, carrier: str) -> str:
        """Connect to the port `name`; returns why not, or an empty text."""

    def remove(self, name: str) -> bool:
        """Disconnect; returns whether there was a connection."""

    def carriers(self) -> dict[str, str]:
        """The carriers by the names of the connected ports."""


class AdministeredPort(Protocol):
    """A port as its administrative commands see it."""

    name: str
    is_rpc: bool
    receiver: Receiver | None
    outputs: Outputs | None
    properties: dict[str, Bottle]

    def inputs(self) -> dict[str, str]:
        """The carriers by the names of the ports that send to this one."""

    def disconnect_input(self, name: str) -> bool:
        """Close the connections from the port `name`; returns whether there were any."""


class ListeningPort(Protocol):
    """A port as its incoming connections see it; `number` is its TCP port."""

    number: int

    def connected(self, incoming: Any) -> None:
        """A connection has sent its name and carrier."""

    def name_requests(self, stream: YarpStream) -> Callable[[], None] | None:
        """What serves the requests of the name server's own carrier; None: no name server."""

    def handle(
        self, incoming: Any, command: str, bottle: Bottle, size: int, envelope: str
    ) -> Bottle | None:
        """Handle one message; returns the reply."""

    def malformed(self, sender: str, error: MalformedMessage, command: str) -> Bottle | None:
        """A message cannot be read: report it, and return the reply if one is expected."""

    def unwritable(self, error: EncodeError) -> Bottle:
        """What to reply instead of a reply that cannot be written."""

    def report_malformed(self, sender: str, error: MalformedMessage) -> None:
        """Log invalid bytes, limited in rate."""

    def describe(self) -> list[str]:
        """What `yarp ping` and the command `*` show."""
