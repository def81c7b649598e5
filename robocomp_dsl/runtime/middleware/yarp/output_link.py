"""Sends the messages of one port to one other port, and never waits for it for long.

In: messages. Out: a connection that is opened, and opened again, by a thread of the link. What the
system's buffers take at once is sent by the publishing thread.
"""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import TypeAlias

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.middleware.yarp import outgoing
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.outgoing import Resolve
from robocomp_dsl.runtime.middleware.yarp.outgoing_message import OutgoingMessage, Part
from robocomp_dsl.runtime.middleware.yarp.stream import ConnectionLost, Stream

DEPTH = 1000
"""Messages on their way to one reader, if the port states no depth."""
MAX_BYTES = 1 << 27
"""Of all messages on their way to one reader."""
RETRY_S = 0.5
CONNECT_S = 2.0
CLOSE_S = 0.5
"""After the port was closed, the last messages have this time."""
log = logging.getLogger("robocomp")
_Queued: TypeAlias = tuple[Part, OperationCounts]


class OutputLink:
    """One connected reader."""

    def __init__(
        self,
        address: PortAddress,
        sender: str,
        resolve: Resolve,
        depth: int | None,
        *,
        reliable: bool,
        on_end: Callable[[OutputLink], None] | None = None,
    ) -> None:
        """Without `on_end` a lost connection is opened again; else it is called."""
        self.address = address
        self._sender = sender
        self._resolve = resolve
        self._depth = depth or DEPTH
        self._reliable = reliable
        self._on_end = on_end
        self._throttle = Throttle()
        self._changed = threading.Condition()
        self._stream: Stream | None = None
        self._messages: deque[_Queued] = deque()
        self._bytes = 0
        self._drops = 0
        self._is_sending = False
        self._stalled = False
        self._is_absent = False
        self._absent_drops = 0
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=f"yarp {sender} output", daemon=True)

    @property
    def queued_bytes(self) -> int:
        """The size of what is on its way to the reader."""
        return self._bytes

    def start(self, stream: Stream | None = None) -> None:
        """Send from now on, over `stream` if it is open already."""
        self._stream = stream
        self._thread.start()

    def send(self, message: OutgoingMessage, counts: OperationCounts) -> None:
        """Send one message; if there is no room, one is dropped and counted."""
        carrier = self.address.carrier
        with self._changed:
            if self._closed:
                return
            if self._is_absent:
                self._drop(counts)
                return
            if not self._messages and not self._is_sending and carrier == "fast_tcp":
                sent = self._send_now(message.parts)
                if sent == message.wire_size:
                    return
                self._append(message.rest(sent), counts)
                self._is_sending = sent > 0  # a rest is never dropped
            else:
                data = message.owned(text=carrier.startswith("text"))
                if self._has_room(len(data), counts):
                    self._append(data, counts)
            self._changed.notify_all()

    def _send_now(self, parts: Sequence[Part]) -> int:
        """Send what the buffers take; returns the number of bytes."""
        stream = self._stream
        if stream is None or stream.is_closed():
            return 0
        try:
            return stream.send_now(parts)
        except OSError:
            return 0  # the thread of the link finds out why

    def _append(self, data: Part, counts: OperationCounts) -> None:
        self._messages.append((data, counts))
        self._bytes += len(data)

    def _remove(self, index: int) -> OperationCounts:
        """Take a message out of the queue; returns the counts of its operation."""
        data, counts = self._messages[index]
        del self._messages[index]
        self._bytes -= len(data)
        return counts

    def _drop(self, counts: OperationCounts) -> None:
        """Count a message that the reader does not get."""
        counts.drops += 1
        self._drops += 1

    def _has_room(self, size: int, counts: OperationCounts) -> bool:
        if self._has_room_for(size):
            self._stalled = False
            return True
        if not self._reliable:
            while not self._has_room_for(size):
                self._drop(self._remove(int(self._is_sending)))
            if self._throttle.allows("slow"):
                log.warning(
                    "%s: %s does not take the messages in time; it has lost %d%s",
                    *(self._sender, self.address.name, self._drops, counts.suffix),
                )
            return True
        if not self._stalled:
            self._changed.wait_for(
                lambda: self._closed or self._has_room_for(size), bounded_queue.HOLD_S
            )
            if not self._closed and self._has_room_for(size):
                return True
            self._stalled = True
            if self._throttle.allows("held"):
                log.warning(
                    "%s receives nothing and held a publication for %g ms; until it does, it"
                    " loses messages%s",
                    *(self.address.name, bounded_queue.HOLD_S * 1000, counts.suffix),
                )
        self._drop(counts)
        return False

    def _has_room_for(self, size: int) -> bool:
        """Whether a message of `size` bytes fits; one always does."""
        waiting = len(self._messages) - self._is_sending
        return not waiting or (waiting < self._depth and self._bytes + size <= MAX_BYTES)

    def _run(self) -> None:
        while True:
            if self._stream is None and not self._connect():
                return
            try:
                if self._send_messages():
                    return
            except ConnectionLost as error:
                if self._lost(str(error)):
                    return

    def _connect(self) -> bool:
        """Open the connection, and try again until it is; False if the port was closed."""
        while not self._closed:
            try:
                address = self._resolve(self.address)
                stream = outgoing.open_connection(address, self._sender, CONNECT_S)
            except ConnectionLost as error:
                if self._lost(str(error)):
                    return False
                with self._changed:
                    self._changed.wait_for(lambda: self._closed, RETRY_S)
            else:
                with self._changed:
                    self._stream = stream
                    was_absent, self._is_absent = self._is_absent, False
                    lost = self._drops - self._absent_drops
                if was_absent:
                    log.info(
                        "%s is connected to %s; messages lost meanwhile: %d",
                        *(self._sender, self.address.name, lost),
                    )
                return True
        return False

    def _lost(self, reason: str) -> bool:
        """The connection is lost, or was refused; returns whether the link ends."""
        with self._changed:
            stream, self._stream = self._stream, None
            if self._is_sending and self._messages:
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
        if self._throttle.allows("lost"):
            log.warning("%s: no connection to %s: %s%s", self._sender, self.address, reason, suffix)
        return False

    def _lose_messages(self) -> str:
        """Drop all messages until there is a connection again: a reader that comes back would get
        commands that are long out of date. Returns what to add to the warning."""
        if not self._is_absent:
            self._is_absent = True
            self._absent_drops = self._drops
        while self._messages:
            self._drop(self._remove(0))
        return "; until there is one, messages are lost"

    def _send_messages(self) -> bool:
        """Send what arrives; returns whether the link was closed. Raises `ConnectionLost`."""
        stream = self._stream
        assert stream is not None  # noqa: S101 - it has just been connected
        carrier = self.address.carrier
        while True:
            with self._changed:
                if not self._messages:
                    self._changed.wait_for(lambda: self._messages or self._closed, RETRY_S)
                if not self._messages:
                    if self._closed:
                        return self._finish(stream)
                    if stream.is_closed():
                        raise ConnectionLost("the reader closed the connection")
                    continue
                self._is_sending = True
                data, _ = self._messages[0]
            stream.send(data)
            outgoing.read_ack(stream, carrier)
            with self._changed:
                if self._messages:
                    self._remove(0)
                self._is_sending = False
                self._changed.notify_all()

    def _finish(self, stream: Stream) -> bool:
        stream.deadline = time.monotonic() + CLOSE_S
        with contextlib.suppress(ConnectionLost):
            stream.send(outgoing.end_bytes(self.address.carrier))
        stream.close()
        return True

    def close(self) -> None:
        """Send the last messages, and end the connection."""
        with self._changed:
            self._closed = True
            stream = self._stream
            if stream is None:
                while self._messages:
                    self._drop(self._remove(0))
            self._changed.notify_all()
        if threading.current_thread() is self._thread or not self._thread.is_alive():
            return
        self._thread.join(CLOSE_S)
        if stream is not None and self._thread.is_alive():
            stream.close()  # the reader receives nothing
            self._thread.join(CLOSE_S)
