"""A subscribed topic: connections to all its publishers that the master knows.

In: the addresses of publishers. Out: one thread for each, which connects, receives, and connects
again after the connection was lost, as long as the master knows the publisher.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from urllib.parse import urlsplit

from robocomp_dsl.runtime.middleware.ros1.handshake import Refused, exchange_headers
from robocomp_dsl.runtime.middleware.ros1.incoming import TopicReceiver
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi, RosApiError
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import CLOSE_S, CONNECT_S, RETRY_S
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost

_TRANSPORT = "TCPROS"


class TopicSubscription:
    """One topic; `node` is the name of the own node."""

    def __init__(self, receiver: TopicReceiver, node: str) -> None:
        self.receiver = receiver
        self._node = node
        self._changed = threading.Condition()
        self._publishers: frozenset[str] = frozenset()
        self._threads: dict[str, threading.Thread] = {}
        self._closed = False
        self._has_lost = False

    def update(self, publishers: Sequence[str]) -> None:
        """The addresses of all publishers. Connections to others last until these end them."""
        with self._changed:
            if self._closed:
                return
            self._publishers = frozenset(publishers)
            for uri in self._publishers - self._threads.keys():
                thread = threading.Thread(
                    target=self._run, args=(uri,), name=f"ros1 from {uri}", daemon=True
                )
                self._threads[uri] = thread
                thread.start()
            self._changed.notify_all()

    def _run(self, uri: str) -> None:
        is_reported = False
        while True:
            pause = RETRY_S
            try:
                stream, peer = self._connect(uri)
            except Refused as error:
                self.receiver.warn(f"refused {uri}", "the publisher at %s: %s", uri, error)
                pause = 4 * RETRY_S
            except (ConnectionLost, RosApiError) as error:
                if not is_reported and not self._is_ended(uri):
                    is_reported = True
                    name = self.receiver.topic.name
                    self.receiver.warn(uri, "no connection to a publisher of %s: %s", name, error)
            else:
                is_reported = False
                self._receive(stream, peer)
            with self._changed:
                self._changed.wait_for(lambda: self._is_ended(uri), pause)
                if self._is_ended(uri):
                    self._threads.pop(uri, None)
                    return

    def _receive(self, stream: TcprosStream, peer: str) -> None:
        """Receive until the publisher ends. Reports the end, and the connection after one."""
        topic = self.receiver.topic.name
        if self._has_lost:
            self.receiver.inform(f"connected {peer}", "%s is connected to %s", topic, peer)
        try:
            self.receiver.receive(stream, peer)
        except ConnectionLost:
            if not self._closed:
                self._has_lost = True
                self.receiver.inform(f"ended {peer}", "%s: the publisher %s ended", topic, peer)

    def _is_ended(self, uri: str) -> bool:
        return self._closed or uri not in self._publishers

    def _connect(self, uri: str) -> tuple[TcprosStream, str]:
        """A connection that brings messages. Raises `ConnectionLost` and `RosApiError`."""
        api = RosApi(uri, CONNECT_S)
        topic = self.receiver.topic.name
        try:
            reply = api.call("requestTopic", self._node, topic, [[_TRANSPORT]])
        finally:
            api.close()
        if not (isinstance(reply, list) and len(reply) >= 3 and isinstance(reply[2], int)):
            raise ConnectionLost(f"{uri} offers {reply!r:.60} instead of TCPROS, host and port")
        host = str(reply[1]) or urlsplit(uri).hostname or ""
        stream = TcprosStream.connect((host, reply[2]), CONNECT_S)
        try:
            header = exchange_headers(stream, self.receiver.header(), CONNECT_S)
            if refusal := self.receiver.refusal(header):
                raise Refused(refusal)
        except ConnectionLost:
            stream.close()
            raise
        return stream, header.get("callerid", uri)

    def close(self) -> None:
        """End all connections."""
        with self._changed:
            self._closed = True
            threads = list(self._threads.values())
            self._changed.notify_all()
        self.receiver.close()
        deadline = time.monotonic() + CLOSE_S
        for thread in threads:
            if thread is not threading.current_thread():
                thread.join(max(0.0, deadline - time.monotonic()))
