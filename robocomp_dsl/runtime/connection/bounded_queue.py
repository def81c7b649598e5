"""A receive queue that drops no message: a full one holds its publishers, for a limited time.

In: messages from a thread of a middleware. Out: the messages, in order. A subscriber that takes
nothing for `hold_s` seconds gets no more messages until its queue has room again.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

from robocomp_dsl.runtime.component.receiver import QueueClosed

HOLD_S = 1.0
"""How long a subscriber that takes nothing may hold its publishers."""
KEEP_ALL_DEPTH = 10_000
"""Length of a queue that keeps all messages, unless `depth` is specified."""
MAX_BYTES = 1 << 28
"""A queue that holds more is full; one message always fits."""

_T = TypeVar("_T")


class BoundedQueue(Generic[_T]):
    """Queue of at most `depth` messages and `MAX_BYTES`.

    `on_held` is called for each message that finds no room.
    """

    def __init__(
        self,
        depth: int,
        hold_s: float,
        on_held: Callable[[], None] = lambda: None,
        max_bytes: int = MAX_BYTES,
    ) -> None:
        self.hold_s = hold_s
        self._on_held = on_held
        self._depth = depth
        self._max_bytes = max_bytes
        self._bytes = 0
        self._messages: deque[tuple[_T, int]] = deque()
        self._lock = threading.Lock()
        self._room = threading.Condition(self._lock)
        self._arrival = threading.Condition(self._lock)
        self._is_stalled = self._is_closed = False

    def put(self, message: _T, size: int = 0) -> bool:
        """Wait for room and add a message of `size` bytes; False if it was dropped."""
        with self._lock:
            if not self._has_room(size) and not self._is_closed:
                self._on_held()
                if self._is_stalled or not self._wait_for_room(size):
                    self._is_stalled = True
                    return False
            if self._is_closed:
                return False
            self._is_stalled = False
            self._messages.append((message, size))
            self._bytes += size
            self._arrival.notify()
            return True

    def _has_room(self, size: int) -> bool:
        if len(self._messages) >= self._depth:
            return False
        return not self._messages or self._bytes + size <= self._max_bytes

    def _wait_for_room(self, size: int) -> bool:
        """Wait until there is room or the queue is closed; False if it takes too long."""
        return self._room.wait_for(lambda: self._is_closed or self._has_room(size), self.hold_s)

    def take(self) -> _T:
        """The next message. Raises `QueueClosed`."""
        with self._lock:
            while not self._messages:
                if self._is_closed:
                    raise QueueClosed
                self._arrival.wait()
            message, size = self._messages.popleft()
            self._bytes -= size
            self._room.notify()
            return message

    def close(self) -> None:
        """End `put` and `take`, also those that wait, and discard what is queued."""
        with self._lock:
            self._is_closed = True
            self._messages.clear()
            self._room.notify_all()
            self._arrival.notify_all()
