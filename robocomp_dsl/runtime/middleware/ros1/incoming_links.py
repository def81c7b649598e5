"""The incoming connections of a topic, a port or a service."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from robocomp_dsl.runtime.middleware.ros1.subscriber_link import link_numbers
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost


class IncomingLink:
    """One peer that sends; `peer` is the name of its node."""

    def __init__(self, stream: TcprosStream, peer: str) -> None:
        self.number = next(link_numbers)
        self.stream = stream
        self.peer = peer
        self.messages_in = 0


class IncomingLinks:
    """The connections of one receiver, as long as they are served."""

    def __init__(self) -> None:
        self.links: tuple[IncomingLink, ...] = ()
        self.closed = False
        self._lock = threading.Lock()

    @contextmanager
    def serving(self, stream: TcprosStream, peer: str) -> Iterator[IncomingLink]:
        """A link that is listed meanwhile. Raises `ConnectionLost` if the receiver was closed."""
        link = IncomingLink(stream, peer)
        with self._lock:
            self.check_open()
            self.links += (link,)
        try:
            yield link
        finally:
            with self._lock:
                self.links = tuple(each for each in self.links if each is not link)

    def check_open(self) -> None:
        """Raise `ConnectionLost` if the receiver was closed."""
        if self.closed:
            raise ConnectionLost("the port was closed")

    def close(self) -> None:
        """End all connections; running handlers may finish."""
        with self._lock:
            self.closed = True
            links = self.links
        for link in links:
            link.stream.close()
