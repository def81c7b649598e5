"""The TCP port of a node: accepts connections, reads their headers, and passes them on.

In: connections. Out: calls of the handler for the header field `topic`, `service` or `publish_to`.
"""

from __future__ import annotations

import contextlib
import logging
import socket
import threading
import time
from collections.abc import Callable, Mapping
from typing import TypeAlias

from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.errors import MalformedMessage, MiddlewareError
from robocomp_dsl.runtime.middleware.ros1.handshake import refuse
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost, failure_reason

MAX_CONNECTIONS = 2048
"""Connections of one node at a time; further ones are closed at once."""
HEADER_S = 5.0
"""A peer that has connected sends its header within this time."""
Handler: TypeAlias = Callable[[TcprosStream, dict[str, str]], bool]
"""Handles a connection; returns whether it has taken it over, else the connection is closed."""
log = logging.getLogger("robocomp")


class TcprosListener:
    """Raises `MiddlewareError` if it cannot listen."""

    def __init__(self, node: str, host: str, handlers: Mapping[str, Handler]) -> None:
        self._node = node
        self._handlers = handlers
        self._throttle = Throttle()
        self._lock = threading.Lock()
        self._streams: set[TcprosStream] = set()
        self._closed = False
        try:
            self._socket = socket.create_server((host, 0), backlog=128)
        except (OSError, OverflowError) as error:
            raise MiddlewareError(
                f"ros1 cannot listen at {host}: {failure_reason(error)}; choose an address of this"
                " machine with `ros1.host`, ROS_IP or ROS_HOSTNAME"
            ) from None
        self.number: int = self._socket.getsockname()[1]
        self._thread = threading.Thread(target=self._accept, name=f"ros1 {node}", daemon=True)
        self._thread.start()

    def _accept(self) -> None:
        while not self._closed:
            try:
                accepted, _ = self._socket.accept()
            except OSError:
                if self._closed:
                    return
                time.sleep(0.1)  # too many open files: the connection stays in the backlog
                continue
            stream = TcprosStream(accepted)
            with self._lock:
                has_room = not self._closed and len(self._streams) < MAX_CONNECTIONS
                if has_room:
                    self._streams.add(stream)
            if not has_room:
                stream.close()
                continue
            name = f"ros1 {self._node} input"
            threading.Thread(target=self._serve, args=(stream,), name=name, daemon=True).start()

    def _serve(self, stream: TcprosStream) -> None:
        is_taken = False
        try:
            is_taken = self._handle(stream)
        except ConnectionLost:
            pass
        except MalformedMessage as error:
            self.report("malformed", f"a peer sent an invalid header: {error}")
        except Exception as error:
            text = describe_error(error)
            log.error("%s: a connection failed: %s", self._node, text)  # noqa: TRY400 - described
        finally:
            with self._lock:
                self._streams.discard(stream)
            if not is_taken:
                stream.close()

    def _handle(self, stream: TcprosStream) -> bool:
        stream.deadline = time.monotonic() + HEADER_S
        header = stream.header()
        stream.deadline = None
        for key, handler in self._handlers.items():
            if key in header:
                return handler(stream, header)
        refuse(stream, "the header has neither topic nor service")
        return False

    def report(self, key: str, text: str) -> None:
        """Log a warning, limited in rate."""
        if self._throttle.allows(key):
            log.warning("%s: %s", self._node, text)

    def close(self) -> None:
        """Accept nothing more, and end the connections that have not been taken over."""
        with self._lock:
            self._closed = True
            streams = list(self._streams)
        # `shutdown` wakes the thread that accepts; `close` alone would not.
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        for stream in streams:
            stream.close()
        if self._thread is not threading.current_thread():
            self._thread.join(1.0)
