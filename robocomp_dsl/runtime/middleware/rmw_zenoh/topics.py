"""Publishers and subscriptions of ROS topics over rmw_zenoh.

In: encoded messages. Out: samples with the attachment of rmw_zenoh; gaps in its sequence numbers
are counted as drops. A latched topic uses zenoh's advanced publisher, whose cache late subscribers
query, as `rmw_zenoh_cpp` does for the durability "transient local".
"""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import count
from typing import Any

import zenoh
import zenoh.ext

from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.bounded_queue import KEEP_ALL_DEPTH, BoundedQueue
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.rmw_zenoh.operations import topic_info
from robocomp_dsl.runtime.middleware.rmw_zenoh.session import RosSession
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import (
    DEFAULT_DEPTH,
    TopicInfo,
    attachment,
    parse_attachment,
)
from robocomp_dsl.runtime.middleware.ros_common.payload import padded
from robocomp_dsl.runtime.middleware.ros_common.topics import topics_address


class RmwZenohWriter:
    """Publishes on one topic."""

    def __init__(self, session: RosSession, info: TopicInfo, qos: Qos, port: str) -> None:
        self.info = info
        key = info.key(session.domain_id)
        control = zenoh.CongestionControl
        congestion = control.BLOCK if qos.holds_publisher else control.DROP
        self._publisher: Any
        if qos.latched:
            self._publisher = zenoh.ext.declare_advanced_publisher(
                session.zenoh,
                key,
                congestion_control=congestion,
                cache=zenoh.ext.CacheConfig(qos.depth or 1),
                publisher_detection=True,
            )
        else:
            self._publisher = session.zenoh.declare_publisher(key, congestion_control=congestion)
        self._token, self._gid = session.announce("MP", info, qos)
        self._numbers = count(1)
        self._graph = session.graph
        self._graph.watch(info, port)

    def has_subscribers(self) -> bool:
        """Whether another endpoint subscribes to the topic."""
        return bool(self._graph.find("MS", self.info))

    def send(self, data: bytes) -> None:
        """Publish one message."""
        number = attachment(next(self._numbers), time.time_ns(), self._gid)
        self._publisher.put(data, attachment=number)

    def undeclare(self) -> None:
        """End the publisher."""
        self._token.undeclare()
        self._publisher.undeclare()


class RmwZenohReceiver:
    """Receives one topic for one operation; `name` is that of the port."""

    def __init__(
        self, session: RosSession, port: IncomingPort, served: IncomingOperation, name: str
    ) -> None:
        qos = port.at.qos
        self.info = topic_info(name, port.interface, served.operation)
        handle = _sample_handler(served)
        depth = qos.depth or (KEEP_ALL_DEPTH if qos.keep_all else DEFAULT_DEPTH)
        self._queue: BoundedQueue[zenoh.Sample] | None = None
        handler: Any = zenoh.handlers.RingChannel(depth)
        if qos.holds_publisher:
            self._queue = BoundedQueue(depth, bounded_queue.HOLD_S)
            handler = zenoh.handlers.Callback(self._put, indirect=False)
        self._subscriber = self._declare(session, qos, handler)
        self._token, _ = session.announce("MS", self.info, qos)
        session.graph.watch(self.info, port.at.port)
        if self._queue:
            port.receive(self._queue.take, handle)
        else:
            port.receive(self._subscriber.handler.recv, handle, zenoh.ZError)

    def _declare(self, session: RosSession, qos: Qos, handler: Any) -> Any:
        key = self.info.key(session.domain_id)
        if not qos.latched:
            return session.zenoh.declare_subscriber(key, handler)
        history = zenoh.ext.HistoryConfig(
            detect_late_publishers=True, max_samples=qos.depth or DEFAULT_DEPTH
        )
        return zenoh.ext.declare_advanced_subscriber(
            session.zenoh, key, handler, history=history, subscriber_detection=True
        )

    def _put(self, sample: zenoh.Sample) -> None:
        """Queue a sample; the numbers of the samples tell which were dropped."""
        if self._queue:
            self._queue.put(sample, len(sample.payload))

    def undeclare(self) -> None:
        """Receive no more."""
        self._token.undeclare()
        self._subscriber.undeclare()
        if self._queue:
            self._queue.close()


def _sample_handler(served: IncomingOperation) -> Callable[[zenoh.Sample], None]:
    counts, handle = served.counts, served.handle
    decode = padded(served.operation.decode_request)
    latest: dict[bytes, int] = {}

    def handle_sample(sample: zenoh.Sample) -> None:
        try:
            data = sample.payload.to_bytes()
            counts.bytes_in += len(data)
            received = sample.attachment
            if received is not None:
                counts.drops += _lost(received.to_bytes(), latest)
            handle(decode(data))
        except BaseException as error:
            served.report(error)

    return handle_sample


def _lost(received: bytes, latest: dict[bytes, int]) -> int:
    """How many messages are missing before this message; 0 if its number is not readable."""
    try:
        number, _, gid = parse_attachment(received)
    except MalformedMessage:
        return 0  # older versions of rmw_zenoh number otherwise; the message itself is complete
    previous, latest[gid] = latest.get(gid, number - 1), number
    return max(0, number - previous - 1)


class RmwZenohSubscription:
    """A subscribed port; `address` are the topics that it receives."""

    def __init__(self, session: RosSession, port: IncomingPort, topics: tuple[str, ...]) -> None:
        self.address = topics_address(topics)
        self._receivers = [
            RmwZenohReceiver(session, port, served, topic)
            for topic in topics
            for served in port.operations.values()
        ]

    def close(self) -> None:
        """See `transport.Subscription`."""
        for receiver in self._receivers:
            receiver.undeclare()
