"""A published port: its own topic, those of external subscribers, and attached components.

In: values. Out: messages, encoded once for all subscribers.
"""

from __future__ import annotations

from threading import Lock

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.ros1.addresses import RosAddress, parse_address
from robocomp_dsl.runtime.middleware.ros1.description import MIDDLEWARE
from robocomp_dsl.runtime.middleware.ros1.handshake import exchange_headers
from robocomp_dsl.runtime.middleware.ros1.node import RosNode
from robocomp_dsl.runtime.middleware.ros1.operations import topic_of
from robocomp_dsl.runtime.middleware.ros1.port_receiver import frame, port_header
from robocomp_dsl.runtime.middleware.ros1.publication import Publication
from robocomp_dsl.runtime.middleware.ros1.subscriber_link import SubscriberLink
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import CONNECT_S
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.presence.port_record import PortRecord


class Ros1Publisher:
    """A published port; `address` is its own name."""

    def __init__(self, node: RosNode, at: Endpoint, name: str) -> None:
        """Raises `MiddlewareError` for an invalid address."""
        self.address = str(RosAddress(name, node.host, node.listener.number))
        self._node = node
        self._at = at
        self._lock = Lock()
        self._publications: dict[str, tuple[Publication, ...]] = {}
        self._attached: dict[PortRecord, SubscriberLink] = {}
        self._links: tuple[SubscriberLink, ...] = ()
        names = [name]
        names += [
            parse_address(record.address, at.port).name
            for record in at.external
            if record.middleware == MIDDLEWARE.name
        ]
        for operation in at.interface.published:
            of_operation: list[Publication] = []
            for each in dict.fromkeys(names):
                topic = topic_of(each, at.interface, operation)
                of_operation.append(Publication(node.name, topic, at.qos))
            self._publications[operation.name] = tuple(of_operation)
        for publications in self._publications.values():
            for publication in publications:
                node.add_publication(publication)

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.Publisher`."""
        first, *others = self._publications[operation.name]
        index = self._at.interface.operations.index(operation)

        def send(data: bytes, _number: bytes) -> None:
            counts.bytes_out += len(data)
            counter = first.counter()
            first.publish(data, counts, counter)
            for publication in others:
                publication.publish(data, counts)
            links = self._links
            if links:
                message = frame(index, counter, data)
                for link in links:
                    link.send(message, counts)

        return BoundOperation(first.topic.encode, send)

    def attach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        address = parse_address(subscriber.address, subscriber.name)
        header = port_header(self._node.name, address.name, self._at.interface)

        def open_stream() -> TcprosStream:
            stream = TcprosStream.connect((address.host, address.number), CONNECT_S)
            try:
                exchange_headers(stream, header, CONNECT_S)
            except ConnectionLost:
                stream.close()
                raise
            return stream

        with self._lock:
            if subscriber in self._attached:
                return
            link = SubscriberLink(self._node.name, subscriber.name, self._at.qos, open_stream)
            self._attached[subscriber] = link
            self._links = tuple(self._attached.values())
        link.start()

    def detach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        with self._lock:
            link = self._attached.pop(subscriber, None)
            self._links = tuple(self._attached.values())
        if link:
            link.close()

    def has_subscribers(self) -> bool:
        """See `transport.Publisher`."""
        several = self._publications.values()
        return bool(self._links) or any(p.links for each in several for p in each)

    def close(self) -> None:
        """See `transport.Publisher`."""
        with self._lock:
            links, self._links = self._links, ()
            self._attached.clear()
        for link in links:
            link.close()
        for several in self._publications.values():
            for publication in several:
                self._node.remove_publication(publication)
