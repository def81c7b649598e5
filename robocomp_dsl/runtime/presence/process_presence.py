"""Presence within this process: for components that only connect to each other.

In: a domain. Out: a `Presence` that other processes do not see; nothing is opened.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from itertools import count

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry
from robocomp_dsl.runtime.presence.presence import LatestMessage, LatestMessages


class _Domain:
    """The ports of one domain in this process, and the registries that follow them."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.records: dict[str, PortRecord] = {}
        self.registries: list[PortRegistry] = []
        self.latest: dict[tuple[str, str], LatestMessages] = {}
        self.shapes: dict[tuple[str, str], dict[str, str]] = {}


_domains: dict[str, _Domain] = {}
_domains_lock = threading.Lock()
_keys = count()


class ProcessPresence:
    """A `Presence` within the process."""

    house = "inproc"

    def __init__(self, domain: str) -> None:
        self.registry = PortRegistry()
        self._name = domain
        self._own: dict[PortRecord, str] = {}
        with _domains_lock:
            self._domain = _domains.setdefault(domain, _Domain())
            with self._domain.lock:
                self._domain.registries.append(self.registry)
                for key, record in self._domain.records.items():
                    self.registry.add(key, record)

    def declare(self, record: PortRecord) -> None:
        """See `Presence`."""
        key = str(next(_keys))
        with self._domain.lock:
            self._own[record] = key
            self._domain.records[key] = record
            for registry in self._domain.registries:
                registry.add(key, record)

    def withdraw(self, record: PortRecord) -> None:
        """See `Presence`."""
        with self._domain.lock:
            key = self._own.pop(record, None)
            if key is None:
                return
            del self._domain.records[key]
            registries = list(self._domain.registries)
        for registry in registries:
            registry.remove(key)

    def find_servers(self, interface: str, timeout: float) -> list[str]:
        """See `Presence`."""
        found = self.registry.wait("server", interface, lambda _record: True, timeout)
        return sorted({record.component for record in found})

    def publish_state(self, state: str) -> None:
        """No effect: other processes cannot monitor this process."""

    def number_publications(self, at: Endpoint) -> ProcessNumbers:  # noqa: ARG002 - see Presence
        """See `Presence`."""
        return ProcessNumbers()

    def publishers(self) -> None:
        """See `Presence`: losses are counted by the queues of this process."""

    def answer_probes(self) -> None:
        """See `Presence`: every component of this process is alive."""

    def probe(self, component: str, timeout: float, on_reply: Callable[[], None]) -> None:  # noqa: ARG002
        """See `Presence`."""
        on_reply()

    def offer_latest(self, at: Endpoint, latest: LatestMessages) -> OfferedMessages:
        """See `Presence`."""
        return OfferedMessages(self._domain.latest, (at.interface.name, at.name), latest)

    def fetch_latest(
        self, at: Endpoint, publisher: PortRecord, on_message: Callable[[LatestMessage], None]
    ) -> None:
        """See `Presence`."""
        latest = self._domain.latest.get((at.interface.name, publisher.name))
        for message in latest() if latest else ():
            on_message(message)

    def offer_shapes(self, interface: Interface) -> None:
        """See `Presence`."""
        self._domain.shapes[interface.name, interface.hash.hex()] = interface.shapes

    def shapes_of(self, peer: PortRecord) -> dict[str, str] | None:
        """See `Presence`."""
        return self._domain.shapes.get((peer.interface, peer.hash))

    def interrupt(self) -> None:
        """See `Presence`."""
        self.registry.interrupt()

    def close(self) -> None:
        """See `Presence`."""
        for record in list(self._own):
            self.withdraw(record)
        with _domains_lock, self._domain.lock:
            if self.registry in self._domain.registries:
                self._domain.registries.remove(self.registry)
            if not self._domain.registries:
                _domains.pop(self._name, None)


class ProcessNumbers:
    """Numbers of publications that nobody asks for."""

    id = 0

    def counter(self, operation: str) -> count[int]:  # noqa: ARG002 - see PublicationNumbers
        """See `PublicationNumbers`."""
        return count()

    def close(self) -> None:
        """Nothing was announced."""


class OfferedMessages:
    """The latest messages of one published port, which others of the process may ask for."""

    def __init__(
        self,
        offered: dict[tuple[str, str], LatestMessages],
        key: tuple[str, str],
        latest: LatestMessages,
    ) -> None:
        self._offered = offered
        self._key = key
        self._latest = latest
        offered[key] = latest

    def close(self) -> None:
        """See `Closeable`."""
        if self._offered.get(self._key) is self._latest:
            del self._offered[self._key]
