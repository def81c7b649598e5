"""A published port on one or several ROS topics.

In: a function that opens a topic of the middleware. Out: the publisher of a port: it publishes on
its own topic, on those of external subscribers, and on those of subscribers that are attached.
"""

from __future__ import annotations

from collections.abc import Callable
from threading import Lock
from typing import Protocol, TypeAlias

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.ros_common.names import absolute_name
from robocomp_dsl.runtime.middleware.ros_common.topics import topic_to_attach
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.presence.port_record import PortRecord


class TopicWriter(Protocol):
    """The publishing side of one topic."""

    def send(self, data: bytes) -> None:
        """Publish one message."""

    def has_subscribers(self) -> bool:
        """Whether another endpoint subscribes to it."""

    def undeclare(self) -> None:
        """End it."""


OpenTopic: TypeAlias = Callable[[str, Operation], TopicWriter]
"""Opens a topic for an operation: the ROS name of the port, and the operation."""


class RosPublisher:
    """A published port; `address` is its own ROS name."""

    def __init__(self, at: Endpoint, name: str, middleware: str, open_topic: OpenTopic) -> None:
        self.address = name
        self._open = open_topic
        self._operations = at.interface.published
        self._writers: dict[str, tuple[TopicWriter, ...]] = {o.name: () for o in self._operations}
        self._by_topic: dict[str, dict[str, TopicWriter]] = {}
        self._latest: dict[str, bytes] = {}
        self._keeps_latest = bool(at.qos.latched)
        self._subscribers: dict[str, set[PortRecord]] = {}
        self._lock = Lock()
        for record in at.external:
            if record.middleware == middleware:
                self._add(absolute_name(record.address, at.port))
        self._add(name)

    def _add(self, topic: str) -> None:
        if topic in self._by_topic:
            return
        writers = self._by_topic[topic] = {
            operation.name: self._open(topic, operation) for operation in self._operations
        }
        for operation, writer in writers.items():
            self._writers[operation] += (writer,)
            if operation in self._latest:
                writer.send(self._latest[operation])

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.Publisher`."""
        name, writers = operation.name, self._writers

        def publish(data: bytes, _number: bytes) -> None:
            counts.bytes_out += len(data)
            for writer in writers[name]:
                writer.send(data)

        def publish_latched(data: bytes, number: bytes) -> None:
            with self._lock:  # a subscriber that is attached now gets it once
                self._latest[name] = data
                publish(data, number)

        send = publish_latched if self._keeps_latest else publish
        return BoundOperation(operation.encode_request, send)

    def attach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        topic = topic_to_attach(subscriber.address, self.address)
        if topic:
            with self._lock:
                self._subscribers.setdefault(topic, set()).add(subscriber)
                self._add(topic)

    def detach(self, subscriber: PortRecord) -> None:
        """See `transport.Publisher`."""
        topic = topic_to_attach(subscriber.address, self.address)
        with self._lock:
            subscribers = self._subscribers.get(topic, set())
            subscribers.discard(subscriber)
            if subscribers or self._subscribers.pop(topic, None) is None:
                return
            for operation, writer in self._by_topic.pop(topic).items():
                remaining = tuple(w for w in self._writers[operation] if w is not writer)
                self._writers[operation] = remaining
                writer.undeclare()

    def has_subscribers(self) -> bool:
        """See `transport.Publisher`."""
        return any(writer.has_subscribers() for all_ in self._writers.values() for writer in all_)

    def close(self) -> None:
        """See `transport.Publisher`."""
        with self._lock:
            for operation, writers in self._writers.items():
                self._writers[operation] = ()
                for writer in writers:
                    writer.undeclare()
            self._by_topic.clear()
            self._subscribers.clear()
