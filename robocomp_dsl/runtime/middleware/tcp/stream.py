"""A TCP connection that is read by sizes, with a deadline.

In: a socket. Out: bytes. Large messages are received into their place; memory is used only for
bytes that have arrived.
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import time
from collections.abc import Sequence
from typing import Any, Self, TypeAlias

import numpy as np

CHUNK = 1 << 16
Part: TypeAlias = bytes | memoryview


class ConnectionLost(Exception):
    """The connection ended, or its deadline passed (`timed_out`)."""

    def __init__(self, reason: str, *, timed_out: bool = False) -> None:
        super().__init__(reason)
        self.timed_out = timed_out


def failure_reason(error: BaseException) -> str:
    """Why the system refused, without its number."""
    if isinstance(error, OSError) and error.errno and not isinstance(error, socket.gaierror):
        return os.strerror(error.errno)  # without what Python's functions add
    return (isinstance(error, OSError) and error.strerror) or str(error) or "connection failed"


def _lost(error: Exception) -> ConnectionLost:
    return ConnectionLost(failure_reason(error), timed_out=isinstance(error, TimeoutError))


def behind(parts: Sequence[Part], sent: int) -> tuple[Part, ...]:
    """What is left of a message after its first `sent` bytes, without a copy."""
    rest: list[Part] = []
    for part in parts:
        if sent < len(part):
            rest.append(memoryview(part)[sent:] if sent else part)
        sent = max(0, sent - len(part))
    return tuple(rest)


class TcpStream:
    """One connection. `deadline` is a time of `time.monotonic`, None for no limit.

    `bytes_in` counts what was read by sizes.
    """

    def __init__(self, opened: socket.socket) -> None:
        self.socket = opened
        self.deadline: float | None = None
        self.bytes_in = 0
        self._buffer = b""
        self._at = 0
        self._poll = select.poll()
        self._poll.register(opened, select.POLLIN)
        with contextlib.suppress(OSError):
            opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            opened.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        opened.settimeout(None)

    @classmethod
    def connect(cls, at: tuple[str, int], timeout: float) -> Self:
        """A connection to host and TCP port. Raises `ConnectionLost`."""
        try:
            return cls(socket.create_connection(at, timeout))
        except (OSError, UnicodeError, OverflowError) as error:
            raise _lost(error) from None

    def _limit(self) -> None:
        if self.deadline is None:
            if self.socket.gettimeout() is not None:
                self.socket.settimeout(None)
            return
        left = self.deadline - time.monotonic()
        if left <= 0:
            raise TimeoutError
        self.socket.settimeout(left)

    def _receive(self, into: memoryview | None = None) -> Any:
        """Some bytes, or their number if they are received `into` a buffer."""
        try:
            self._limit()
            received = self.socket.recv(CHUNK) if into is None else self.socket.recv_into(into)
        except (OSError, ValueError) as error:
            raise _lost(error) from None
        if not received:
            raise ConnectionLost("the peer closed the connection")
        return received

    def take(self, size: int) -> bytes:
        """The next `size` bytes. Raises `ConnectionLost`."""
        at = self._at
        end = at + size
        if end > len(self._buffer):
            if size > CHUNK:
                return bytes(self.take_view(size))
            self._buffer = self._buffer[at:]
            at, end = 0, size
            while len(self._buffer) < size:
                data = self._receive()
                self._buffer = self._buffer + data if self._buffer else data
        self._at = end
        self.bytes_in += size
        return self._buffer[at:end]

    def take_view(self, size: int) -> Part:
        """As `take`, for large messages: received once, into memory of their own."""
        if size <= CHUNK:
            return self.take(size)
        try:
            target = np.empty(size, np.uint8).data
        except MemoryError:
            raise ConnectionLost(f"there is no memory for a message of {size} bytes") from None
        filled = min(size, len(self._buffer) - self._at)
        target[:filled] = self._buffer[self._at : self._at + filled]
        self._at += filled
        if self._at == len(self._buffer):
            self._buffer, self._at = b"", 0
        while filled < size:
            filled += self._receive(target[filled:])
        self.bytes_in += size
        return target.toreadonly()

    def send(self, *parts: Part) -> None:
        """Send all bytes. Raises `ConnectionLost`."""
        try:
            self._limit()
            for part in behind(parts, self.socket.sendmsg(parts)):
                self.socket.sendall(part)
        except (OSError, ValueError) as error:
            raise _lost(error) from None

    def send_now(self, parts: Sequence[Part]) -> int:
        """Send what the system takes at once; returns the number of bytes. Raises `OSError`."""
        if self.socket.gettimeout() is not None:
            self.socket.settimeout(None)  # with a timeout, Python would wait
        try:
            return self.socket.sendmsg(parts, (), socket.MSG_DONTWAIT)
        except BlockingIOError:
            return 0

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

    def close(self) -> None:
        """End the connection; a thread that reads it gets `ConnectionLost`."""
        with contextlib.suppress(OSError):
            self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()
