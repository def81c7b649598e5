"""Publishing: one connection to each subscriber, which never holds the publisher.

In: messages, and the records of subscribers. Out: each message in the socket of each subscriber, or
in a queue before it that drops its oldest message. A reliable publication waits for room instead,
for a limited time.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.codec import Message, message_encoder
from robocomp_dsl.runtime.middleware.local.flusher import Flusher
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool
from robocomp_dsl.runtime.middleware.local.ports import head_of
from robocomp_dsl.runtime.middleware.local.subscriber_socket import SubscriberSocket
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.presence.port_record import PortRecord


class LocalPublisher:
    """A published port."""

    address = ""

    def __init__(self, at: Endpoint, flusher: Flusher, pool: MemoryPool) -> None:
        self._pool = pool
        self._at = at
        self._flusher = flusher
        self._lock = threading.Lock()
        self._links: dict[PortRecord, SubscriberSocket] = {}
        self._current: tuple[SubscriberSocket, ...] = ()

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.Publisher`."""
        head = head_of(packets.PUBLICATION, self._at.interface, operation)
        encode = message_encoder(operation.inputs, self._pool)
        return BoundOperation(encode, self._publication(head, counts))

    def _publication(
        self, head: bytes, counts: OperationCounts
    ) -> Callable[[Message, bytes], None]:
        def publish(message: Message, number: bytes) -> None:
            shared = None
            if isinstance(message, bytes):
                packet = head + number + message
                counts.bytes_out += len(message)
            else:
                packet, shared = head + number, message
                counts.bytes_out += message.size
            for link in self._current:
                link.put(packet, shared, counts)

        return publish

    def attach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        with self._lock:
            if subscriber not in self._links:
                link = SubscriberSocket(self._at, subscriber, self._flusher)
                self._links[subscriber] = link
                self._current = tuple(self._links.values())

    def detach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        with self._lock:
            link = self._links.pop(subscriber, None)
            self._current = tuple(self._links.values())
        if link:
            link.close()

    def has_subscribers(self) -> bool:
        """See `transport.Publisher`."""
        return any(not link.lost for link in self._current)

    def close(self) -> None:
        """See `transport.Publisher`."""
        for subscriber in list(self._links):
            self.detach(subscriber)
