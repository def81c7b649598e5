"""Which subscribers a published port reaches, and on which of its middlewares.

In: the port, its middlewares, the port registry. Out: records of subscribers.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.interface_version import is_other_version
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.published_port import PublishedPort
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry


class SubscriberSelection:
    """The subscribers of the port `at`, which may change, on each of its middlewares `ports`."""

    def __init__(
        self, registry: PortRegistry, at: Endpoint, ports: Sequence[PublishedPort]
    ) -> None:
        self._registry = registry
        self.at = at
        self._ports = ports
        self.attaching = [p for p in ports if p.capabilities.attaches_subscribers]

    def to_attach(self) -> dict[tuple[str, PortRecord], PublishedPort]:
        """Each subscriber once: on the first middleware of this port that it has."""
        found = self._find()
        current: dict[tuple[str, PortRecord], PublishedPort] = {}
        reached = {
            record.name
            for record in found
            for port in self._ports
            if record.middleware == port.middleware and port not in self.attaching
        }
        for port in self.attaching:
            for record in found:
                if (
                    record.middleware == port.middleware
                    and record.name not in reached
                    and self._is_subscriber(record)
                ):
                    current[port.middleware, record] = port
            reached |= {record.name for _, record in current}
        return current

    def of_all_versions(self) -> list[PortRecord]:
        """The subscribers with any version of the interface, where the middleware carries it."""
        capable = {p.middleware for p in self._ports if p.capabilities.topic_versions}
        return [r for r in self._find() if r.middleware in capable and self._subscribes(r)]

    def is_other(self, record: PortRecord) -> bool:
        """Whether this is a subscriber in another component."""
        if record.component == self.at.component:
            return False
        return self._is_subscriber(record) or record in self.of_all_versions()

    def is_any_known(self) -> bool:
        """Whether the registry has a subscriber of this version of the interface."""
        return any(self._is_subscriber(record) for record in self._find())

    def clear(self) -> None:
        """The port is closed: it has no subscribers."""
        self._ports, self.attaching = (), []

    def _find(self) -> list[PortRecord]:
        return list(self._registry.find("subscriber", self.at.interface.name))

    def _is_subscriber(self, record: PortRecord) -> bool:
        """Whether a port on the same middleware subscribes to this version of this port."""
        return not is_other_version(self.at, record) and self._subscribes(record)

    def _subscribes(self, record: PortRecord) -> bool:
        at = Endpoint(self.at.interface, record.component, record.port, record.peers)
        return any(port.middleware == record.middleware for port in self._ports) and matches(
            at, self.at.component, self.at.port
        )
