"""The TCP port of a node: reads the headers of its connections, and passes them on.

In: connections. Out: calls of the handler for the header field `topic`, `service` or `port`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import TypeAlias

from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1.handshake import refuse
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.listener import TcpListener

MAX_CONNECTIONS = 2048
"""Connections of one node at a time."""
HEADER_S = 5.0
"""A peer that has connected sends its header within this time."""
_HINT = "; choose an address of this machine with `ros1.host`, ROS_IP or ROS_HOSTNAME"
Handler: TypeAlias = Callable[[TcprosStream, dict[str, str]], bool]
"""Handles a connection; returns whether it has taken it over, else the connection is closed."""


class TcprosListener(TcpListener[TcprosStream]):
    """Raises `MiddlewareError` if it cannot listen."""

    def __init__(self, node: str, host: str, handlers: Mapping[str, Handler]) -> None:
        super().__init__(
            node, "ros1", (host, 0), TcprosStream, self._handle, MAX_CONNECTIONS, _HINT
        )
        self._handlers = handlers
        self.start()

    def _handle(self, stream: TcprosStream) -> bool:
        stream.deadline = time.monotonic() + HEADER_S
        try:
            header = stream.header()
        except MalformedMessage as error:
            self.report("malformed", f"a peer sent an invalid header: {error}")
            return False
        stream.deadline = None
        for key, handler in self._handlers.items():
            if key in header:
                return handler(stream, header)
        refuse(stream, "the header has neither topic nor service")
        return False
