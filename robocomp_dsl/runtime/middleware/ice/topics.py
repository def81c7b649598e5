"""Published and subscribed ports on Ice.

A publisher sends to each subscriber itself. IceStorm is used only where a connection names it.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any

import Ice

from robocomp_dsl.runtime.codec.ice import codec
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.ice.addresses import ICESTORM
from robocomp_dsl.runtime.middleware.ice.client import mode_of, parse_proxy
from robocomp_dsl.runtime.middleware.ice.icestorm import TopicLink
from robocomp_dsl.runtime.middleware.ice.server import names_of
from robocomp_dsl.runtime.middleware.ice.subscriber_link import IceSubscriberLink
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.presence.port_record import PortRecord


class IcePublisher:
    """A published port."""

    address = ""

    def __init__(self, communicator: Any, at: Endpoint, topic_manager: str) -> None:
        self._communicator = communicator
        self._at = at
        self._names = names_of(at.interface)
        self._links: dict[PortRecord, IceSubscriberLink] = {}
        self._topics: list[StormPublisher] = []
        for record in at.external:
            if record.middleware != "ice":
                continue
            if record.address.startswith(ICESTORM):
                topic = record.address.removeprefix(ICESTORM)
                self._topics.append(StormPublisher(communicator, at, topic_manager, topic))
            else:
                self.attach(record)

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `Publisher`."""
        name, mode = self._names[operation.name], mode_of(operation)
        links, topics = self._links, self._topics

        def send(data: bytes, _number: bytes) -> None:
            for link in tuple(links.values()):
                link.send(name, mode, data, counts)
            for topic in topics:
                topic.send(name, mode, data, counts)
            counts.bytes_out += len(data)

        return BoundOperation(codec.request_encoder(operation), send)

    def attach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        proxy = parse_proxy(self._communicator, subscriber.address, subscriber.name)
        qos = self._at.qos
        self._links[subscriber] = IceSubscriberLink(
            proxy, subscriber.name, qos.depth, reliable=qos.holds_publisher
        )

    def detach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        link = self._links.pop(subscriber, None)
        if link:
            link.close()

    def has_subscribers(self) -> bool:
        """See `Publisher`; IceStorm tells nobody whether a topic has subscribers."""
        return bool(self._links or self._topics)

    def close(self) -> None:
        """See `Publisher`."""
        for subscriber in tuple(self._links):
            self.detach(subscriber)
        for topic in self._topics:
            topic.close()


class StormPublisher:
    """Publishes to one topic of IceStorm; without IceStorm, publications are dropped."""

    def __init__(self, communicator: Any, at: Endpoint, manager: str, topic: str) -> None:
        self._at = at
        self._name = f"IceStorm's topic {topic}"
        self._sender: IceSubscriberLink | None = None
        self._proxy: Any = None
        self._link = TopicLink(communicator, manager, topic, at.name, self._connect)

    def _connect(self, topic: Any) -> None:
        proxy = topic.getPublisher()
        if proxy != self._proxy or self._sender is None or self._sender.is_broken:
            if self._sender:
                self._sender.close()
            qos = self._at.qos
            self._proxy = proxy
            self._sender = IceSubscriberLink(
                proxy, self._name, qos.depth, reliable=qos.holds_publisher
            )

    def send(self, name: str, mode: Any, data: bytes, counts: OperationCounts) -> None:
        """Send one publication."""
        sender = self._sender
        if sender is None:
            counts.drops += 1
            return
        sender.send(name, mode, data, counts)
        if sender.is_broken and self._link.connected.is_set():
            self._link.check()

    def close(self) -> None:
        """End the connection."""
        self._link.close()
        if self._sender:
            self._sender.close()


class StormSubscription:
    """Subscribes a servant to one topic of IceStorm."""

    def __init__(
        self, communicator: Any, at: Endpoint, manager: str, topic: str, proxy: Any
    ) -> None:
        reliable = at.qos.holds_publisher
        self._proxy = proxy.ice_twoway() if reliable else proxy.ice_oneway()
        self._qos = {"reliability": "ordered"} if reliable else {}
        self._topic: Any = None
        self._link = TopicLink(communicator, manager, topic, at.name, self._connect)

    def _connect(self, topic: Any) -> None:
        if self._proxy.ice_getIdentity() not in topic.getSubscribers():
            topic.subscribeAndGetPublisher(self._qos, self._proxy)
        self._topic = topic

    def close(self) -> None:
        """End the subscription."""
        self._link.close()
        if self._topic:
            with contextlib.suppress(Ice.Exception):
                self._topic.unsubscribe(self._proxy)


class IceSubscription:
    """A subscribed port: its servant, its queue, and its topics of IceStorm."""

    def __init__(
        self,
        address: str,
        remove: Callable[[], None],
        close_queue: Callable[[], None],
        topics: list[StormSubscription],
    ) -> None:
        self.address = address
        self._remove = remove
        self._close_queue = close_queue
        self._topics = topics

    def close(self) -> None:
        """See `Subscription`."""
        for topic in self._topics:
            topic.close()
        self._remove()
        self._close_queue()
