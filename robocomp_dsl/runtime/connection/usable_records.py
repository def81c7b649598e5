"""Which ports of others a port can be connected to, by their middlewares.

In: a port, and records of a presence. Out: whether this process can reach a port.
"""

from __future__ import annotations

import os

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.middleware import registry
from robocomp_dsl.runtime.middleware.capabilities import Capabilities
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import Presence


def is_usable(at: Endpoint, record: PortRecord) -> bool:
    """Whether `at` can be connected to the port of `record`."""
    if at.middlewares and record.middleware not in at.middlewares:
        return False
    capabilities = registry.known_capabilities(record.middleware)
    return capabilities is not None and is_reachable(record, capabilities)


def is_reachable(record: PortRecord, capabilities: Capabilities) -> bool:
    """Whether the port is in this process, or its middleware connects processes.

    The address of a port that only its process can reach starts with the process id.
    """
    return capabilities.between_processes or record.address.startswith(f"{os.getpid()}-")


def middlewares_of_subscribers(at: Endpoint, presence: Presence) -> tuple[str, ...]:
    """The house's, and those of the subscribers to the published port `at` that are known now."""
    used = [
        record.middleware
        for record in presence.registry.find("subscriber", at.interface.name)
        if is_usable(at, record) and _subscribes(record, at)
    ]
    return tuple(dict.fromkeys((presence.house, *used)))


def _subscribes(record: PortRecord, at: Endpoint) -> bool:
    subscriber = Endpoint(at.interface, record.component, record.port, record.peers)
    return matches(subscriber, at.component, at.port)
