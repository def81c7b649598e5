"""The receive queue of a port. A full queue drops the oldest message; if reliable, it waits.

In: messages from the threads of connections. Out: a thread of the port passes them on, in order.
Where the queue waits, the connection is not read, and TCP holds the sender.
"""

from __future__ import annotations

import threading
from collections import deque
from typing import Any

from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.connection.incoming_port import Handle, IncomingOperation, IncomingPort

DEPTH = 1000
RELIABLE_DEPTH = 256
"""Default queue lengths."""


class ReaderQueue:
    """The queue of one served or subscribed port."""

    def __init__(self, port: IncomingPort) -> None:
        self._reliable = bool(port.at.qos.reliable)
        self._depth = port.at.qos.depth or (RELIABLE_DEPTH if self._reliable else DEPTH)
        self._messages: deque[tuple[IncomingOperation, Handle, Any]] = deque()
        self._lock = threading.Lock()
        self._arrived = threading.Condition(self._lock)
        self._room = threading.Condition(self._lock)
        self._closed = False
        port.receive(self._take, self._handle)

    def put(self, served: IncomingOperation, handle: Handle, arguments: Any) -> None:
        """Add a message; waits for room if the port is reliable."""
        with self._lock:
            while len(self._messages) >= self._depth and not self._closed:
                if self._reliable:
                    self._room.wait()
                else:
                    self._messages.popleft()[0].counts.drops += 1
            if not self._closed:
                self._messages.append((served, handle, arguments))
                self._arrived.notify()

    def _take(self) -> tuple[IncomingOperation, Handle, Any]:
        with self._lock:
            while not self._messages and not self._closed:
                self._arrived.wait()
            if self._closed:
                raise QueueClosed
            self._room.notify()
            return self._messages.popleft()

    @staticmethod
    def _handle(message: tuple[IncomingOperation, Handle, Any]) -> None:
        served, handle, arguments = message
        try:
            handle(arguments)
        except BaseException as error:
            served.report(error)

    def close(self) -> None:
        """Pass no further message to a handler."""
        with self._lock:
            self._closed = True
            self._messages.clear()
            self._arrived.notify_all()
            self._room.notify_all()
