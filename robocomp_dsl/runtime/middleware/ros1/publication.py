"""A published topic: its subscribers, each with a link.

Subscribers connect to the node. A latched topic sends its latest message to each new one.
"""

from __future__ import annotations

import threading
from itertools import count

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.ros1 import tcpros
from robocomp_dsl.runtime.middleware.ros1.handshake import refusal
from robocomp_dsl.runtime.middleware.ros1.operations import Ros1Topic
from robocomp_dsl.runtime.middleware.ros1.subscriber_link import SubscriberLink
from robocomp_dsl.runtime.middleware.ros1.tcpros import LENGTH, TcprosStream
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import TcpMessage

_MAX_COUNT = 1 << 32


class Publication:
    """One topic of a node under its name."""

    def __init__(self, node: str, topic: Ros1Topic, qos: Qos) -> None:
        self.topic = topic
        self._node = node
        self._qos = qos
        self._lock = threading.Lock()
        self._links: tuple[SubscriberLink, ...] = ()
        self._numbers = count(1)
        self._latest: TcpMessage | None = None
        self._counts = OperationCounts("", "")

    @property
    def links(self) -> tuple[SubscriberLink, ...]:
        """The links to the subscribers."""
        return self._links

    def refusal(self, header: dict[str, str]) -> str:
        """Why a subscriber cannot be connected; empty if it can."""
        return refusal(self.topic.name, self.topic.type, header, "subscribes to")

    def reply_header(self) -> dict[str, str]:
        """What the publisher tells a subscriber."""
        type_ = self.topic.type
        return {
            "callerid": self._node,
            "latching": "1" if self._qos.latched else "0",
            "md5sum": type_.md5,
            "message_definition": type_.definition,
            "topic": self.topic.name,
            "type": type_.name,
        }

    def accept(self, stream: TcprosStream, peer: str) -> None:
        """Send to a subscriber that has connected. Raises `ConnectionLost`."""
        stream.send(tcpros.encode_header(self.reply_header()))
        link = SubscriberLink(self._node, peer, self._qos, on_end=self._remove)
        with self._lock:
            self._links += (link,)
            if self._latest is not None:
                link.send(self._latest, self._counts)
        link.start(stream)

    def _remove(self, link: SubscriberLink) -> None:
        with self._lock:
            self._links = tuple(each for each in self._links if each is not link)

    def counter(self) -> bytes:
        """The next counter for the header of a message; empty if it has none."""
        if not self.topic.type.counts:
            return b""
        return LENGTH.pack(next(self._numbers) % _MAX_COUNT)

    def publish(self, data: bytes, counts: OperationCounts, counter: bytes | None = None) -> None:
        """Send a message to all subscribers, with this counter, else the next."""
        if not self._links and not self._qos.latched:
            return
        counter = self.counter() if counter is None else counter
        message = TcpMessage(LENGTH.pack(len(counter) + len(data)) + counter, data)
        if self._qos.latched:
            with self._lock:
                self._latest = message
                self._counts = counts
                for link in self._links:
                    link.send(message, counts)
        else:
            for link in self._links:
                link.send(message, counts)

    def close(self) -> None:
        """End all links."""
        with self._lock:
            links, self._links = self._links, ()
        for link in links:
            link.close()
