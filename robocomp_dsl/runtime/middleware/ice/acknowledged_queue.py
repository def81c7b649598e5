"""The receive queue of a reliable subscription: a full queue holds its publishers.

In: messages from Ice's threads. Out: the messages in order, by a thread of the port. A message
beyond the depth is acknowledged when the next message is taken, and a publisher waits for that.
"""

from __future__ import annotations

import threading
from collections import deque
from queue import SimpleQueue
from typing import Any, TypeAlias

import Ice

from robocomp_dsl.runtime.codec.ice import wire
from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.connection.bounded_queue import KEEP_ALL_DEPTH, MAX_BYTES
from robocomp_dsl.runtime.connection.incoming_port import Handle, IncomingOperation, IncomingPort

DEPTH = 256
"""Default queue length."""
_DONE = (True, wire.EMPTY)
Message: TypeAlias = tuple[IncomingOperation, Handle, Any, int]
"""Operation, handler, arguments, and the size in bytes."""


class AcknowledgedQueue:
    """The queue of one subscribed port."""

    def __init__(self, port: IncomingPort) -> None:
        qos = port.at.qos
        self._depth = qos.depth or (KEEP_ALL_DEPTH if qos.keep_all else DEPTH)
        self._lock = threading.Lock()
        self._messages: SimpleQueue[Message | None] = SimpleQueue()
        self._unacknowledged: deque[Any] = deque()
        self._length = self._bytes = 0
        port.receive(self._take, self._handle)

    def put(
        self,
        served: IncomingOperation,
        handle: Handle,
        arguments: Any,
        size: int,
        *,
        is_answered: bool,
    ) -> Any:
        """Add a message of `size` bytes; returns the acknowledgement, or its future.

        A full queue drops the message of a publisher that does not wait for answers.
        """
        with self._lock:
            full = self._length >= self._depth or self._bytes > MAX_BYTES
            if full and not is_answered:
                served.counts.drops += 1
                return _DONE
            self._length += 1
            self._bytes += size
            self._messages.put((served, handle, arguments, size))
            if not full:
                return _DONE
            acknowledgement = Ice.Future()
            self._unacknowledged.append(acknowledgement)
            return acknowledgement

    def _take(self) -> Message:
        message = self._messages.get()
        if message is None:
            self._messages.put(None)  # for the other threads of the port
            raise QueueClosed
        with self._lock:
            self._length -= 1
            self._bytes -= message[3]
            oldest = self._unacknowledged.popleft() if self._unacknowledged else None
        if oldest:
            oldest.set_result(_DONE)
        return message

    @staticmethod
    def _handle(message: Message) -> None:
        served, handle, arguments, _ = message
        try:
            handle(arguments)
        except BaseException as error:
            served.report(error)

    def close(self) -> None:
        """Pass no further message to a handler."""
        self._messages.put(None)
        with self._lock:
            waiting, self._unacknowledged = self._unacknowledged, deque()
        for acknowledgement in waiting:
            acknowledgement.set_result(_DONE)
