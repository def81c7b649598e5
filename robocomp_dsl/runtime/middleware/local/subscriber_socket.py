"""The connection of a publisher to one subscriber.

In: packets. Out: the packets in the socket, in order. What does not fit waits in a queue of the
subscriber's depth, which drops its oldest packet; `flush` moves it into the socket.
"""

from __future__ import annotations

import errno
import fcntl
import logging
import select
import termios
import threading
import time
from collections import deque
from struct import Struct
from typing import TypeAlias

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection.bounded_queue import KEEP_ALL_DEPTH
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.flusher import Flusher
from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket
from robocomp_dsl.runtime.middleware.local.memory_pool import SharedMessage
from robocomp_dsl.runtime.middleware.local.ports import hello_packet, parse_address
from robocomp_dsl.runtime.presence.port_record import PortRecord

HOLD_S = 1.0
"""How long a reliable subscriber that takes nothing may hold a publication."""
DEPTH = 256
"""Length of the queue until the subscriber has told its own."""
MAX_QUEUED_BYTES = 1 << 28
MAX_QUEUED_SHARED = 200
"""Each keeps a descriptor."""
MAX_SHARED = 4
"""So many large messages may wait in the socket: the queue behind it can drop its oldest."""
_POLL_MS = 5
_PAUSE_S = 0.001
_COUNT = Struct("i")
_ZERO = bytes(_COUNT.size)
_TOO_MANY_DESCRIPTORS = errno.ETOOMANYREFS
_HELD = "%s receives nothing and held %s.%s for %.1f s; until it does, it loses messages"
log = logging.getLogger("robocomp")

_Entry: TypeAlias = "tuple[bytes, SharedMessage | None, OperationCounts]"


class SubscriberSocket:
    """Never blocks, unless the publisher is reliable. `lost`: the subscriber has ended."""

    def __init__(self, at: Endpoint, subscriber: PortRecord, flusher: Flusher) -> None:
        self.lost = False
        self._subscriber = subscriber.name
        self._flusher = flusher
        self._reliable = at.qos.holds_publisher
        self._capacity = (at.qos.depth or KEEP_ALL_DEPTH) if at.qos.keep_all else 0
        self._path, port = parse_address(subscriber.address)
        self._hello = hello_packet(at, port, packets.PUBLICATION)
        self._lock = threading.Lock()
        self._queue: deque[_Entry] = deque()
        self._depth = DEPTH
        self._greeted = False
        self._stalled = False
        self._shared = 0
        self._throttle = Throttle()
        self._socket = packets.new_socket(0)
        self._socket.setblocking(False)
        self._connected = False
        with self._lock:
            self._try(self._connect)

    def _connect(self) -> None:
        """Connect and greet. Raises `BlockingIOError` if the subscriber is too busy now."""
        self._socket.connect(self._path)
        self._connected = True
        self._socket.send(self._hello)

    def _try(self, action: object, *arguments: object) -> bool:
        """Call `action`; False if there is no room. A broken connection is lost for good."""
        try:
            action(*arguments)  # type: ignore[operator]
        except BlockingIOError:
            return False
        except OSError as error:
            if error.errno == _TOO_MANY_DESCRIPTORS:
                return False
            self._lose()
        return True

    def put(self, packet: bytes, shared: SharedMessage | None, counts: OperationCounts) -> None:
        """Send a packet, or queue it."""
        with self._lock:
            if self.lost:
                return
            if not self._queue and self._try(self._send, packet, shared):
                self._stalled = False
            elif not self._reliable:
                self._append(packet, shared, counts)
                self._limit()
            elif self._has_room(shared):
                self._stalled = False
                self._append(packet, shared, counts)
            else:
                self._hold(packet, shared, counts)

    def _append(self, packet: bytes, shared: SharedMessage | None, counts: OperationCounts) -> None:
        self._queue.append((packet, shared, counts))
        self._flusher.add(self)

    def _has_room(self, shared: SharedMessage | None) -> bool:
        """Whether the queue of a connection that keeps all messages takes another message."""
        if len(self._queue) >= self._capacity:
            return False
        if shared is None:
            return True
        sizes = [each.size for _, each, _ in self._queue if each]
        return len(sizes) < MAX_QUEUED_SHARED and sum(sizes) < MAX_QUEUED_BYTES

    def _send(self, packet: bytes, shared: SharedMessage | None) -> None:
        if not self._connected:
            self._connect()
        if shared is None:
            self._socket.send(packet)
            return
        if self._shared >= MAX_SHARED:
            if _COUNT.unpack(fcntl.ioctl(self._socket, termios.TIOCOUTQ, _ZERO))[0]:
                raise BlockingIOError
            self._shared = 0
        packets.send_shared(self._socket, packet, shared)
        self._shared += 1

    def _hold(self, packet: bytes, shared: SharedMessage | None, counts: OperationCounts) -> None:
        """Wait for room for a reliable publication; drop it if the subscriber takes nothing."""
        start = time.monotonic()
        poll = select.poll()
        poll.register(self._socket, select.POLLOUT)
        while not self._stalled and not self.lost and time.monotonic() - start < HOLD_S:
            if poll.poll(_POLL_MS):
                time.sleep(_PAUSE_S)
            self._flush()
            if not self._queue and self._try(self._send, packet, shared):
                return
            if self._has_room(shared):
                self._append(packet, shared, counts)
                return
        if not self._stalled:
            self._stalled = True
            if self._throttle.allows("held"):
                names = counts.port, counts.operation
                log.warning(_HELD, self._subscriber, *names, time.monotonic() - start)
        counts.drops += 1

    def flush(self) -> bool:
        """Move packets from the queue into the socket; returns whether any was moved."""
        if not self._lock.acquire(blocking=False):  # a publisher is held, and flushes itself
            return False
        try:
            return self._flush()
        finally:
            self._lock.release()

    def _flush(self) -> bool:
        moved = False
        while self._queue and not self.lost:
            packet, shared, _ = self._queue[0]
            if not self._try(self._send, packet, shared):
                break
            moved = True
            if self._queue:
                self._queue.popleft()
        return moved

    @property
    def has_queue(self) -> bool:
        """Whether packets wait."""
        return bool(self._queue)

    def _limit(self) -> None:
        """Drop the oldest packets of a queue that is too long or holds too much memory."""
        if not self._greeted:
            self._read_greeting()
        size = sum(shared.size for _, shared, _ in self._queue if shared)
        while len(self._queue) > self._depth or (size > MAX_QUEUED_BYTES and len(self._queue) > 1):
            _, shared, counts = self._queue.popleft()
            counts.drops += 1
            size -= shared.size if shared else 0

    def _read_greeting(self) -> None:
        """The depth of the subscriber, if it has answered."""
        try:
            answer = packets.receive_plain(self._socket)
        except (OSError, MalformedPacket):
            return
        end = packets.HEAD.size + packets.DEPTH.size
        if len(answer) == end and answer[0] == packets.READY:
            self._greeted = True
            self._depth = max(1, packets.DEPTH.unpack(answer[-packets.DEPTH.size :])[0])

    def _lose(self) -> None:
        self.lost = True
        self._queue.clear()
        self._socket.close()

    def close(self) -> None:
        """End the connection."""
        with self._lock:
            self._lose()
