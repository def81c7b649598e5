"""Sends messages to one peer, and never waits for it for long.

In: messages. Out: a connection that is opened, and opened again, by a thread of the link. What the
system's buffers take at once is sent by the publishing thread, the rest by the thread of the link.
"""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost, Part, TcpStream, behind

DEPTH = 1000
"""Messages on their way to one peer, if the port states no depth."""
RETRY_S = 0.5
CONNECT_S = 2.0
CLOSE_S = 0.5
"""After the port was closed, the last messages have this time."""
log = logging.getLogger("robocomp")


class TcpMessage:
    """One message for any number of peers: `parts`, of `wire_size` bytes together."""

    def __init__(self, *parts: Part) -> None:
        self.parts = parts
        self.wire_size = sum(map(len, parts))

    def rest(self, sent: int) -> tuple[Part, ...]:
        """The bytes behind the first `sent`, in memory that nobody changes."""
        return behind(self.parts, sent)


class OutgoingLink:
    """One peer. `sender` and `peer` are the names that messages contain.

    A subclass opens the connection. With `on_end`, a lost connection ends the link, and `on_end` is
    called; without, it is opened again.
    """

    sends_at_once = True
    """Whether the publishing thread may send."""

    def __init__(
        self, sender: str, peer: str, qos: Qos, on_end: Callable[[Any], None] | None = None
    ) -> None:
        self.peer = peer
        self.where = peer
        """Name of the peer, and its address if it has one, for messages."""
        self.messages_out = 0
        self.bytes_out = 0
        self._sender = sender
        self._depth = qos.depth or DEPTH
        self._reliable = qos.holds_publisher
        self._on_end = on_end
        self._throttle = Throttle()
        self._changed = threading.Condition()
        self._stream: TcpStream | None = None
        self._queue: deque[tuple[tuple[Part, ...], int, OperationCounts]] = deque()
        self._bytes = 0
        self._drops = 0
        self._is_sending = False
        self._stalled = False
        self._is_absent = False
        self._absent_drops = 0
        self._closed = False
        name = f"{sender} to {peer}"
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def _open(self) -> TcpStream:
        """A new connection. Raises `ConnectionLost`."""
        raise NotImplementedError

    def _sent(self, stream: TcpStream) -> None:
        """A message was sent: wait for its acknowledgement, if there is one."""

    def _finish(self, stream: TcpStream) -> None:
        """Send what ends a connection. May raise `ConnectionLost`."""

    @property
    def queued_bytes(self) -> int:
        """The size of what is on its way to the peer."""
        return self._bytes

    @property
    def is_connected(self) -> bool:
        """Whether there is a connection."""
        return self._stream is not None

    def start(self, stream: TcpStream | None = None) -> None:
        """Send from now on, over `stream` if it is open already."""
        self._stream = stream
        self._thread.start()

    def send(self, message: TcpMessage, counts: OperationCounts) -> None:
        """Send one message; if there is no room, one is dropped and counted."""
        size = message.wire_size
        with self._changed:
            if self._closed:
                return
            if self._is_absent:
                self._drop(counts)
                return
            self.messages_out += 1
            self.bytes_out += size
            if self.sends_at_once and not self._queue and not self._is_sending:
                sent = self._send_now(message)
                if sent == size:
                    return
                self._append(message.rest(sent), size - sent, counts)
                self._is_sending = sent > 0  # a rest is never dropped
            elif self._has_room(size, counts):
                self._append(message.rest(0), size, counts)
            self._changed.notify_all()

    def _send_now(self, message: TcpMessage) -> int:
        """Send what the buffers take; returns the number of bytes."""
        stream = self._stream
        if stream is None or stream.is_closed():
            return 0
        try:
            return stream.send_now(message.parts)
        except OSError:
            return 0  # the thread of the link finds out why

    def _append(self, parts: tuple[Part, ...], size: int, counts: OperationCounts) -> None:
        self._queue.append((parts, size, counts))
        self._bytes += size

    def _remove(self, index: int) -> OperationCounts:
        """Take a message out of the queue; returns the counts of its operation."""
        _, size, counts = self._queue[index]
        del self._queue[index]
        self._bytes -= size
        return counts

    def _drop(self, counts: OperationCounts) -> None:
        """Count a message that the peer does not get."""
        counts.drops += 1
        self._drops += 1

    def _has_room(self, size: int, counts: OperationCounts) -> bool:
        if self._fits(size):
            self._stalled = False
            return True
        if not self._reliable:
            while not self._fits(size):
                self._drop(self._remove(int(self._is_sending)))
            text = "%s: %s does not take the messages in time; it has lost %d%s"
            self._warn("slow", text, self._sender, self.peer, self._drops, counts.suffix)
            return True
        if not self._stalled:
            hold_s = bounded_queue.HOLD_S
            self._changed.wait_for(lambda: self._closed or self._fits(size), hold_s)
            if not self._closed and self._fits(size):
                return True
            self._stalled = True
            self._warn(
                "held",
                "%s receives nothing and held a publication for %g ms; until it does, it"
                " loses messages%s",
                *(self.peer, hold_s * 1000, counts.suffix),
            )
        self._drop(counts)
        return False

    def _fits(self, size: int) -> bool:
        """Whether a message of `size` bytes fits; one always does."""
        waiting = len(self._queue) - self._is_sending
        if not waiting:
            return True
        return waiting < self._depth and self._bytes + size <= bounded_queue.MAX_BYTES

    def _warn(self, key: str, text: str, *values: Any) -> None:
        if self._throttle.allows(key):
            log.warning(text, *values)

    def _run(self) -> None:
        while self._stream is not None or self._connect():
            try:
                self._send_queued(self._stream)
            except ConnectionLost as error:
                if self._lost(error):
                    return
            else:
                return

    def _connect(self) -> bool:
        """Open the connection, and try again until it is; False if the port was closed."""
        while not self._closed:
            try:
                stream = self._open()
            except ConnectionLost as error:
                if self._lost(error):
                    return False
                with self._changed:
                    self._changed.wait_for(lambda: self._closed, RETRY_S)
            else:
                with self._changed:
                    self._stream = stream
                    was_absent, self._is_absent = self._is_absent, False
                    lost = self._drops - self._absent_drops
                if was_absent:
                    text = "%s is connected to %s; messages lost meanwhile: %d"
                    log.info(text, self._sender, self.peer, lost)
                return True
        return False

    def _lost(self, error: ConnectionLost) -> bool:
        """The connection is lost, or was refused; returns whether the link ends."""
        with self._changed:
            stream, self._stream = self._stream, None
            if self._is_sending and self._queue:
                # Perhaps a rest, which a new connection cannot take.
                self._drop(self._remove(0))
            self._is_sending = False
            ends = self._closed or self._on_end is not None
            suffix = "" if ends or self._reliable else self._lose_messages()
        if stream:
            stream.close()
        if ends:
            if self._on_end:
                self._on_end(self)
            return True
        text = "%s: no connection to %s: %s%s"
        self._warn("lost", text, self._sender, self.where, error, suffix)
        return False

    def _lose_messages(self) -> str:
        """Drop all messages until there is a connection; returns what to add to the warning.

        A peer that comes back would get commands that are long out of date.
        """
        if not self._is_absent:
            self._is_absent = True
            self._absent_drops = self._drops
        while self._queue:
            self._drop(self._remove(0))
        return "; until there is one, messages are lost"

    def _send_queued(self, stream: Any) -> None:
        """Send what arrives until the link is closed. Raises `ConnectionLost`."""
        while True:
            with self._changed:
                if not self._queue:
                    self._changed.wait_for(lambda: self._queue or self._closed, RETRY_S)
                if not self._queue:
                    if self._closed:
                        break
                    if stream.is_closed():
                        raise ConnectionLost("the peer closed the connection")
                    continue
                self._is_sending = True
                parts = self._queue[0][0]
            stream.send(*parts)
            self._sent(stream)
            with self._changed:
                if self._queue:
                    self._remove(0)
                self._is_sending = False
                self._changed.notify_all()
        stream.deadline = time.monotonic() + CLOSE_S
        self._finish(stream)
        stream.close()

    def close(self) -> None:
        """Send the last messages, and end the connection."""
        with self._changed:
            self._closed = True
            stream = self._stream
            if stream is None:
                while self._queue:
                    self._drop(self._remove(0))
            else:
                stream.deadline = time.monotonic() + CLOSE_S
            self._changed.notify_all()
        if threading.current_thread() is self._thread or not self._thread.is_alive():
            return
        self._thread.join(CLOSE_S)
        if stream is not None and self._thread.is_alive():
            stream.close()  # the peer receives nothing
            self._thread.join(CLOSE_S)
