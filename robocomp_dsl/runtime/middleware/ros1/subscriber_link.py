"""Sends the messages of one topic to one subscriber, and never waits for it for long.

In: messages. Out: a TCPROS connection. What the system's buffers take at once is sent by the
publishing thread, the rest by a thread of the link.
"""

from __future__ import annotations

import itertools
import logging
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.ros1.tcpros import PeerLost, TcprosStream

DEPTH = 1000
"""Messages on their way to one subscriber, if the port states no depth."""
MAX_BYTES = 1 << 28
"""Of these messages together; one always fits."""
RETRY_S = 0.5
CLOSE_S = 0.5
"""After the port was closed, the last messages have this time."""
Frame: TypeAlias = tuple[bytes, bytes]
"""The length of a message, with what the publisher adds, and its body."""
link_numbers = itertools.count(1)
log = logging.getLogger("robocomp")


class SubscriberLink:
    """One subscriber, `peer` by its name.

    `open_stream` opens the connection, also again after it was lost; None: the subscriber opened
    `stream`, and the link ends with it. `on_end` is called then.
    """

    def __init__(
        self,
        peer: str,
        qos: Qos,
        *,
        stream: TcprosStream | None = None,
        open_stream: Callable[[], TcprosStream] | None = None,
        on_end: Callable[[SubscriberLink], None] | None = None,
    ) -> None:
        self.peer = peer
        self.number = next(link_numbers)
        self.messages_out = 0
        self.bytes_out = 0
        self._depth = qos.depth or DEPTH
        self._reliable = qos.holds_publisher
        self._stream = stream
        self._open = open_stream
        self._on_end = on_end
        self._throttle = Throttle()
        self._changed = threading.Condition()
        self._queue: deque[Any] = deque()
        self._bytes = 0
        self._is_sending = False
        self._stalled = False
        self._drops = 0
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=f"ros1 to {peer}", daemon=True)

    def start(self) -> None:
        """Send from now on."""
        self._thread.start()

    @property
    def is_connected(self) -> bool:
        """Whether there is a connection."""
        return self._stream is not None

    def send(self, frame: Frame, counts: OperationCounts) -> None:
        """Send one message; if there is no room, one is dropped and counted."""
        with self._changed:
            if self._closed:
                return
            self.messages_out += 1
            self.bytes_out += len(frame[1])
            if not self._queue and not self._is_sending:
                rest = self._send_now(frame)
                if rest is None:
                    self._append(frame)
                elif len(rest):
                    self._append((rest,))
                    self._is_sending = True  # a rest is never dropped
                else:
                    return
            elif self._has_room(len(frame[1]), counts):
                self._append(frame)
            self._changed.notify_all()

    def _append(self, buffers: Any) -> None:
        self._queue.append(buffers)
        self._bytes += sum(map(len, buffers))

    def _pop(self, index: int = 0) -> None:
        self._bytes -= sum(map(len, self._queue[index]))
        del self._queue[index]

    def _send_now(self, frame: Frame) -> Any:
        """Send what the buffers take; returns the rest, None if nothing was sent."""
        stream = self._stream
        if stream is None or stream.is_closed():
            return None
        try:
            rest = stream.send_now(frame)
        except OSError:
            return None  # the thread of the link finds out why
        return None if len(rest) == len(frame[0]) + len(frame[1]) else rest

    def _has_room(self, size: int, counts: OperationCounts) -> bool:
        if self._fits(size):
            self._stalled = False
            return True
        if not self._reliable:
            while len(self._queue) > self._is_sending and not self._fits(size):
                self._pop(int(self._is_sending))
                counts.drops += 1
                self._drops += 1
            if self._throttle.allows("slow"):
                log.warning(
                    "the subscriber %s does not take the messages in time; it has lost %d%s",
                    *(self.peer, self._drops, counts.suffix),
                )
            return True
        if not self._stalled:
            fits = self._changed.wait_for
            fits(lambda: self._closed or self._fits(size), bounded_queue.HOLD_S)
            if not self._closed and self._fits(size):
                return True
            self._stalled = True
            if self._throttle.allows("held"):
                log.warning(
                    "%s receives nothing and held a publication for %g ms; until it does, it"
                    " loses messages%s",
                    *(self.peer, bounded_queue.HOLD_S * 1000, counts.suffix),
                )
        counts.drops += 1
        self._drops += 1
        return False

    def _fits(self, size: int) -> bool:
        waiting = len(self._queue) - self._is_sending
        return waiting < self._depth and (not waiting or self._bytes + size <= MAX_BYTES)

    def _run(self) -> None:
        while True:
            if self._stream is None and not self._connect():
                return
            try:
                if self._send_queued():
                    return
            except PeerLost as error:
                if self._lost(str(error)):
                    return

    def _connect(self) -> bool:
        """Open the connection, and try again until it is; False if the port was closed."""
        while not self._closed and self._open:
            try:
                stream = self._open()
            except PeerLost as error:
                if self._lost(str(error)):
                    return False
                with self._changed:
                    self._changed.wait_for(lambda: self._closed, RETRY_S)
            else:
                with self._changed:
                    self._stream = stream
                return True
        return False

    def _lost(self, reason: str) -> bool:
        """The connection is lost, or was refused; returns whether the link ends."""
        with self._changed:
            stream, self._stream = self._stream, None
            if self._is_sending and self._queue:
                self._pop()  # a rest, which a new connection cannot take
            self._is_sending = False
        if stream:
            stream.close()
        if self._closed or self._open is None:
            if self._on_end:
                self._on_end(self)
            return True
        if self._throttle.allows("lost"):
            log.warning("no connection to the subscriber %s: %s", self.peer, reason)
        return False

    def _send_queued(self) -> bool:
        """Send what arrives; returns whether the link was closed. Raises `PeerLost`."""
        stream = self._stream
        assert stream is not None  # noqa: S101 - it has just been connected
        while True:
            with self._changed:
                if not self._queue:
                    self._changed.wait_for(lambda: self._queue or self._closed, RETRY_S)
                if not self._queue:
                    if self._closed:
                        stream.close()
                        return True
                    if stream.is_closed():
                        raise PeerLost("the subscriber closed the connection")
                    continue
                self._is_sending = True
                buffers = self._queue[0]
            stream.send(*buffers)
            with self._changed:
                if self._queue:
                    self._pop()
                self._is_sending = False
                self._changed.notify_all()

    def close(self) -> None:
        """Send the last messages, and end the connection."""
        with self._changed:
            self._closed = True
            stream = self._stream
            if stream is None:
                self._queue.clear()
            else:
                stream.deadline = time.monotonic() + CLOSE_S
            self._changed.notify_all()
        if threading.current_thread() is self._thread or not self._thread.is_alive():
            return
        self._thread.join(CLOSE_S)
        if stream is not None and self._thread.is_alive():
            stream.close()  # the subscriber receives nothing
            self._thread.join(CLOSE_S)
