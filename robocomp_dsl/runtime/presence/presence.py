"""Protocol of a presence: makes the ports of a component known, and knows those of others."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple, Protocol, TypeAlias

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry


class PublicationNumbers(Protocol):
    """Numbers the publications of one port. `id` is the random id of the publisher."""

    id: int

    def counter(self, operation: str) -> Any:
        """An iterator over the numbers of an operation; `next` of it is safe in any thread."""

    def close(self) -> None:
        """Take back the announcement."""


class LatestMessage(NamedTuple):
    """The latest message of an operation.

    `data` is CDR. `number` are the 16 bytes of `SEQUENCE_FORMAT`; a later message has a higher one.
    """

    operation: str
    number: bytes
    data: bytes


LatestMessages: TypeAlias = Callable[[], Iterable[LatestMessage]]


class Closeable(Protocol):
    """Something that ends with `close`."""

    def close(self) -> None:
        """End it."""


class Presence(Protocol):
    """The presence of one component, or of a client, in one domain.

    `house` is the middleware that shares its connection: the interface `Component`, clocks and
    lock-step use it.
    """

    house: str
    registry: PortRegistry

    def declare(self, record: PortRecord) -> None:
        """Make a port known; after it was opened, so that it can be used when it is seen."""

    def withdraw(self, record: PortRecord) -> None:
        """Make a port unknown."""

    def find_servers(self, interface: str, timeout: float) -> list[str]:
        """The components that serve `interface`, sorted; waits up to `timeout` s for the first."""

    def publish_state(self, state: str) -> None:
        """Publish the lifecycle state to monitors of the domain; "" before the end."""

    def number_publications(self, at: Endpoint) -> PublicationNumbers:
        """Announce a publisher whose messages carry numbers."""

    def publishers(self) -> Any:
        """The `PublisherRegistry` of the domain; None if this presence counts no publications."""

    def answer_probes(self) -> None:
        """Let other components ask this component for a sign of life; it has publishers."""

    def probe(self, component: str, timeout: float, on_reply: Callable[[], None]) -> None:
        """Ask a component for a sign of life; `on_reply` is called in any thread, or never."""

    def offer_latest(self, at: Endpoint, latest: LatestMessages) -> Closeable:
        """Let late subscribers ask for the latest messages of a published port."""

    def fetch_latest(
        self, at: Endpoint, publisher: PortRecord, on_message: Callable[[LatestMessage], None]
    ) -> None:
        """Ask a publisher of `at` for its latest messages; `on_message` is called in any thread."""

    def offer_shapes(self, interface: Interface) -> None:
        """Let peers with another version of `interface` ask for the shapes of its operations."""

    def shapes_of(self, peer: PortRecord) -> dict[str, str] | None:
        """The shapes of the operations of a peer's port, by name; None if it does not reply."""

    def interrupt(self) -> None:
        """Wake all waiting threads; ports count as lost from now on."""

    def close(self) -> None:
        """Leave the domain."""
