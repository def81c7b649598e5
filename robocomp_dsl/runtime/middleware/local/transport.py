"""All connections of one component over `local`.

Services: the client connects to the server, from each thread that calls. Topics: the publisher
connects to each subscriber. Every process has one socket file for all its served and subscribed
ports of one component.
"""

from __future__ import annotations

import threading
import weakref
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.client import LocalClient
from robocomp_dsl.runtime.middleware.local.flusher import Flusher
from robocomp_dsl.runtime.middleware.local.listener import Listener
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool
from robocomp_dsl.runtime.middleware.local.publisher import LocalPublisher
from robocomp_dsl.runtime.middleware.local.receiving import ReceivingPort
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.incoming_port import IncomingPort


_AnyPort: TypeAlias = ReceivingPort | LocalClient | LocalPublisher
_Port = TypeVar("_Port", ReceivingPort, LocalClient, LocalPublisher)


def open_transport(context: TransportContext) -> LocalTransport:
    """The transport of a component."""
    return LocalTransport(context)


class LocalTransport:
    """See `transport.Transport`."""

    def __init__(self, context: TransportContext) -> None:
        # No reference to itself or the context: what is closed is freed at once.
        self._listener = Listener(context.folder, context.fail)
        self._flusher = Flusher(context.fail)
        self._pool = MemoryPool()
        self._lock = threading.Lock()
        self._ports: weakref.WeakSet[_AnyPort] = weakref.WeakSet()

    def serve(self, port: IncomingPort) -> ReceivingPort:
        """See `transport.Transport`."""
        return self._add(ReceivingPort(port, packets.QUERY, self._listener, self._pool))

    def subscribe(self, port: IncomingPort) -> ReceivingPort:
        """See `transport.Transport`."""
        return self._add(ReceivingPort(port, packets.PUBLICATION, self._listener, self._pool))

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> LocalClient:
        """See `transport.Transport`."""
        return self._add(LocalClient(at, server, timeout, self._pool))

    def advertise(self, at: Endpoint) -> LocalPublisher:
        """See `transport.Transport`."""
        return self._add(LocalPublisher(at, self._flusher, self._pool))

    def _add(self, port: _Port) -> _Port:
        with self._lock:
            self._ports.add(port)
        return port

    def close(self) -> None:
        """See `transport.Transport`."""
        self._listener.close()
        with self._lock:
            ports = list(self._ports)
        for port in ports:
            port.close()
        self._flusher.close()
