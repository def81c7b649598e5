"""A TCP connection that is read by sizes and lines, with a deadline.

In: a socket. Out: bytes. Memory grows only with bytes that have arrived.
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import time
from collections.abc import Sequence

import numpy as np

_CHUNK = 1 << 16
_LARGE_CHUNK = 1 << 20
_RESERVED = 1 << 24
"""Memory of this size is reserved before its bytes have arrived."""
MAX_LINE = 1 << 24
"""Bytes of a line of a text carrier."""


class ConnectionLost(Exception):
    """The connection ended, or its deadline passed (`timed_out`)."""

    def __init__(self, reason: str, *, timed_out: bool = False) -> None:
        super().__init__(reason)
        self.timed_out = timed_out


def connect(at: tuple[str, int], timeout: float) -> Stream:
    """A connection to host and TCP port. Raises `ConnectionLost`."""
    try:
        opened = socket.create_connection(at, timeout)
    except (OSError, UnicodeError) as error:
        timed_out = isinstance(error, TimeoutError)
        raise ConnectionLost(reason(error), timed_out=timed_out) from None
    return Stream(opened)


def reason(error: BaseException) -> str:
    """Why the system refused, without its number."""
    if isinstance(error, OSError) and error.errno and not isinstance(error, socket.gaierror):
        return os.strerror(error.errno)  # without what Python's functions add
    return (isinstance(error, OSError) and error.strerror) or str(error) or "connection failed"


class Stream:
    """One connection. `deadline` is a time of `time.monotonic`, None for no limit."""

    def __init__(self, opened: socket.socket) -> None:
        self.socket = opened
        self.deadline: float | None = None
        self._buffer = bytearray()
        self._poll = select.poll()
        self._poll.register(opened, select.POLLIN)
        with contextlib.suppress(OSError):
            opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def _limit(self) -> None:
        if self.deadline is None:
            self.socket.settimeout(None)
            return
        left = self.deadline - time.monotonic()
        if left <= 0:
            raise TimeoutError
        self.socket.settimeout(left)

    def _receive(self, size: int) -> None:
        try:
            self._limit()
            data = self.socket.recv(size)
        except OSError as error:
            timed_out = isinstance(error, TimeoutError)
            raise ConnectionLost(reason(error), timed_out=timed_out) from None
        if not data:
            raise ConnectionLost("the peer closed the connection")
        self._buffer += data

    def take(self, size: int) -> bytes:
        """The next `size` bytes. Raises `ConnectionLost`."""
        buffer = self._buffer
        while len(buffer) < size:
            self._receive(max(_CHUNK, min(size - len(buffer), _LARGE_CHUNK)))
        with memoryview(buffer) as view:
            data = bytes(view[:size])
        del buffer[:size]
        return data

    def take_view(self, size: int) -> memoryview:
        """As `take`, for large messages: received once, into memory of their own."""
        if size <= _CHUNK:
            return memoryview(self.take(size))
        memory = np.empty(min(size, _RESERVED), np.uint8)
        filled = min(size, len(self._buffer))
        memory[:filled] = np.frombuffer(self._buffer, np.uint8, filled)
        del self._buffer[:filled]
        while filled < size:
            if filled == len(memory):
                former, memory = memory, np.empty(min(size, 2 * filled), np.uint8)
                memory[:filled] = former
            filled += self._receive_into(memory.data[filled:])
        return memory.data.toreadonly()

    def _receive_into(self, view: memoryview) -> int:
        try:
            self._limit()
            size = self.socket.recv_into(view)
        except OSError as error:
            timed_out = isinstance(error, TimeoutError)
            raise ConnectionLost(reason(error), timed_out=timed_out) from None
        if not size:
            raise ConnectionLost("the peer closed the connection")
        return size

    def line(self) -> str:
        """The next line without its end. Raises `ConnectionLost`, also for a line too long."""
        searched = 0
        while (end := self._buffer.find(b"\n", searched)) < 0:
            searched = len(self._buffer)
            if searched > MAX_LINE:
                raise ConnectionLost(f"a line has more than {MAX_LINE} bytes")
            self._receive(_CHUNK)
        return self.take(end + 1).decode(errors="surrogateescape").rstrip("\r\n")

    def send(self, data: bytes | memoryview) -> None:
        """Send all of `data`. Raises `ConnectionLost`."""
        try:
            self._limit()
            self.socket.sendall(data)
        except OSError as error:
            timed_out = isinstance(error, TimeoutError)
            raise ConnectionLost(reason(error), timed_out=timed_out) from None

    def send_line(self, text: str) -> None:
        """Send a line. Raises `ConnectionLost`."""
        self.send(text.encode(errors="surrogateescape") + b"\r\n")

    def is_closed(self) -> bool:
        """Whether the peer has closed the connection; never blocks."""
        try:
            # With a timeout, Python would wait before it calls `recv`.
            if not self._poll.poll(0):
                return False
            return self.socket.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT) == b""
        except BlockingIOError:
            return False
        except (OSError, ValueError):
            return True

    def send_now(self, parts: Sequence[bytes | memoryview]) -> int:
        """Send what the buffers of the system take; returns the bytes sent. Raises `OSError`."""
        self.socket.settimeout(None)
        return self.socket.sendmsg(parts, (), socket.MSG_DONTWAIT)

    def close(self) -> None:
        """End the connection; a thread that reads it gets `ConnectionLost`."""
        with contextlib.suppress(OSError):
            self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()
