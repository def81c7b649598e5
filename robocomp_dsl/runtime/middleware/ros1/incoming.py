"""Receives the messages of one topic for one operation of a port.

In: connections to publishers. Out: arguments in the queue of the port.
"""

from __future__ import annotations

import logging
from contextlib import closing
from typing import Any

from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1.handshake import refusal
from robocomp_dsl.runtime.middleware.ros1.incoming_links import IncomingLink, IncomingLinks
from robocomp_dsl.runtime.middleware.ros1.operations import Ros1Topic, topic_of
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost

log = logging.getLogger("robocomp")


class TopicReceiver:
    """One topic of a subscribed port, or of a command of a served port; `name` is the port's."""

    def __init__(
        self,
        node: str,
        name: str,
        port: IncomingPort,
        served: IncomingOperation,
        queue: MessageQueue,
    ) -> None:
        self.topic: Ros1Topic = topic_of(name, port.interface, served.operation)
        self.port = port.at.name
        self._node = node
        self._served = served
        self._queue = queue
        self._throttle = Throttle()
        self.connections = IncomingLinks()
        """The publishers that are connected."""

    def header(self) -> dict[str, str]:
        """What a subscriber tells a publisher."""
        return {
            "callerid": self._node,
            "md5sum": self.topic.type.md5,
            "tcp_nodelay": "1",
            "topic": self.topic.name,
            "type": self.topic.type.name,
            "message_definition": self.topic.type.definition,
        }

    def refusal(self, header: dict[str, str]) -> str:
        """Why a publisher cannot be connected; empty if it can."""
        return refusal(self.topic.name, self.topic.type, header, "publishes")

    def receive(self, stream: TcprosStream, peer: str) -> None:
        """Receive until the connection ends, which raises `ConnectionLost`."""
        with closing(stream), self.connections.serving(stream, peer) as link:
            self._receive(link)

    def _receive(self, link: IncomingLink) -> None:
        frame = link.stream.frame
        while True:
            try:
                data = frame()
            except MalformedMessage as error:
                self._malformed(link.peer, error)
                raise ConnectionLost(str(error)) from None
            link.messages_in += 1
            self.handle(data, link.peer)

    def handle(self, data: Any, peer: str) -> None:
        """Pass one message to the queue, or report it as malformed."""
        served = self._served
        served.counts.bytes_in += len(data)
        try:
            arguments = self.topic.decode(data)
        except MalformedMessage as error:
            self._malformed(peer, error)
        else:
            self._queue.put(served, served.handle, arguments)

    def _malformed(self, peer: str, error: MalformedMessage) -> None:
        located = MalformedMessage(
            f"{error.reason} (from {peer} on {self.topic.name})", error.path, error.offset
        )
        self._served.report(located)

    def warn(self, key: str, text: str, *values: Any) -> None:
        """Log a warning, limited in rate for each key."""
        if self._throttle.allows(key):
            log.warning(f"%s: {text}%s", self.port, *values, self._served.counts.suffix)

    def inform(self, key: str, text: str, *values: Any) -> None:
        """Log what happens in a normal run, limited in rate for each key."""
        if self._throttle.allows(key):
            log.info(f"%s: {text}", self.port, *values)

    def close(self) -> None:
        """End all connections."""
        self.connections.close()
