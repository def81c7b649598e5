"""The receive queue of a port whose messages come from threads of others.

In: messages from any thread. Out: a thread of the port that passes them to their operations. A full
queue drops the oldest message, and counts it.
"""

from __future__ import annotations

from collections import deque
from queue import SimpleQueue
from typing import Any

from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.connection.incoming_port import Handle, IncomingOperation, IncomingPort

DEPTH = 1000
"""Default queue length."""


class MessageQueue:
    """The queue of one served or subscribed port."""

    def __init__(self, port: IncomingPort) -> None:
        self._messages: deque[tuple[IncomingOperation, Handle, tuple[Any, ...]]] = deque(
            maxlen=port.at.qos.depth or DEPTH
        )
        self._wakeup: SimpleQueue[bool] = SimpleQueue()
        port.receive(self._take, self._handle)

    def put(self, served: IncomingOperation, handle: Handle, arguments: tuple[Any, ...]) -> None:
        """Add a message of an operation; `handle` is `served.handle`, or that of a source."""
        if len(self._messages) == self._messages.maxlen:
            self._messages[0][0].counts.drops += 1
        self._messages.append((served, handle, arguments))
        self._wakeup.put(True)

    def _take(self) -> tuple[IncomingOperation, Handle, tuple[Any, ...]]:
        while True:
            if not self._wakeup.get():
                self._wakeup.put(False)  # for the other threads of the port
                raise QueueClosed
            # A dropped message leaves a wake-up behind.
            if self._messages:
                return self._messages.popleft()

    @staticmethod
    def _handle(message: tuple[IncomingOperation, Handle, tuple[Any, ...]]) -> None:
        served, handle, arguments = message
        try:
            handle(arguments)
        except BaseException as error:
            served.report(error)

    def close(self) -> None:
        """Pass no further message to a handler."""
        self._messages.clear()
        self._wakeup.put(False)
