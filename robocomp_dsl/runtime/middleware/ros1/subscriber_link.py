"""The connection to one subscriber of a topic, or of a port of a component."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.ros1.tcpros import LENGTH, TcprosStream
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import OutgoingLink

link_numbers = itertools.count(1)


class SubscriberLink(OutgoingLink):
    """One subscriber; `number` identifies the connection in the statistics of the node.

    A subscriber of ROS has opened the connection, and the link ends with it (`on_end`); to a
    component, `open_stream` opens it.
    """

    def __init__(
        self,
        node: str,
        peer: str,
        qos: Qos,
        open_stream: Callable[[], TcprosStream] | None = None,
        on_end: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(node, peer, qos, on_end)
        self.number = next(link_numbers)
        self._open_stream = open_stream

    @property
    def body_bytes(self) -> int:
        """The bytes of the messages sent, without their lengths."""
        return self.bytes_out - LENGTH.size * self.messages_out

    def _open(self) -> TcprosStream:
        assert self._open_stream  # noqa: S101 - else the link ends with its connection
        return self._open_stream()
