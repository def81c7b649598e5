"""The receive queue of a port whose messages come from threads of others.

In: messages from any thread. Out: a thread of the port that passes them to their operations.
Dropped messages are counted.
"""

from __future__ import annotations

from collections import deque
from queue import SimpleQueue
from typing import Any, TypeAlias

from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.bounded_queue import KEEP_ALL_DEPTH, BoundedQueue
from robocomp_dsl.runtime.connection.incoming_port import Handle, IncomingOperation, IncomingPort

DEPTH = 1000
"""Default queue length."""

Message: TypeAlias = tuple[IncomingOperation, Handle, tuple[Any, ...]]


class MessageQueue:
    """The queue of one served or subscribed port.

    A full queue drops its oldest message. With `reliable` or `keep_all` the thread that delivers
    waits instead, for a limited time.
    """

    def __init__(self, port: IncomingPort) -> None:
        qos = port.at.qos
        self._messages: deque[Message] = deque(maxlen=qos.depth or DEPTH)
        self._wakeup: SimpleQueue[bool] = SimpleQueue()
        self._bounded: BoundedQueue[Message] | None = None
        if qos.holds_publisher:
            depth = qos.depth or (KEEP_ALL_DEPTH if qos.keep_all else DEPTH)
            self._bounded = BoundedQueue(depth, bounded_queue.HOLD_S, port.count_held)
        take = self._take if self._bounded is None else self._bounded.take
        port.receive(take, self._handle)

    def put(self, served: IncomingOperation, handle: Handle, arguments: tuple[Any, ...]) -> None:
        """Add a message of an operation; `handle` is `served.handle`, or that of a source."""
        if self._bounded is not None:
            if not self._bounded.put((served, handle, arguments)):
                served.counts.drops += 1
            return
        if len(self._messages) == self._messages.maxlen:
            self._messages[0][0].counts.drops += 1
        self._messages.append((served, handle, arguments))
        self._wakeup.put(True)

    def _take(self) -> Message:
        while True:
            if not self._wakeup.get():
                self._wakeup.put(False)  # for the other threads of the port
                raise QueueClosed
            # A dropped message leaves a wake-up behind.
            if self._messages:
                return self._messages.popleft()

    @staticmethod
    def _handle(message: Message) -> None:
        served, handle, arguments = message
        try:
            handle(arguments)
        except BaseException as error:
            served.report(error)

    def close(self) -> None:
        """Pass no further message to a handler."""
        self._messages.clear()
        self._wakeup.put(False)
        if self._bounded is not None:
            self._bounded.close()
