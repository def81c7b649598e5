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
from robocomp_dsl.runtime.middleware.ros1.node import RosNode
from robocomp_dsl.runtime.middleware.ros1.operations import topic_of
from robocomp_dsl.runtime.middleware.ros1.output_link import OutputLink
from robocomp_dsl.runtime.middleware.ros1.publication import Publication
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name
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
        self._attached: dict[PortRecord, list[tuple[Publication, OutputLink]]] = {}
        names = [name]
        names += [
            parse_address(record.address, at.port).name
            for record in at.external
            if record.middleware == MIDDLEWARE.name
        ]
        for operation in at.interface.operations:
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
        publish = first.publish

        def send(data: bytes, _number: bytes) -> None:
            counts.bytes_out += len(data)
            publish(data, counts)
            for publication in others:
                publication.publish(data, counts)

        return BoundOperation(first.topic.encode, send)

    def attach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        address = parse_address(subscriber.address, subscriber.name)
        interface = self._at.interface
        with self._lock:
            if subscriber in self._attached:
                return
            self._attached[subscriber] = [
                (
                    self._publications[operation.name][0],
                    self._publications[operation.name][0].dial(
                        address.host,
                        address.number,
                        operation_name(address.name, interface, operation),
                    ),
                )
                for operation in interface.operations
            ]

    def detach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        with self._lock:
            links = self._attached.pop(subscriber, [])
        for publication, link in links:
            publication.drop(link)

    def has_subscribers(self) -> bool:
        """See `transport.Publisher`."""
        return any(p.links for several in self._publications.values() for p in several)

    def close(self) -> None:
        """See `transport.Publisher`."""
        for several in self._publications.values():
            for publication in several:
                self._node.remove_publication(publication)
