"""TCPROS: headers and frames of a connection (http://wiki.ros.org/ROS/TCPROS).

In: bytes of a peer. Out: fields and messages, or `MalformedMessage`. A message has a length of 4
bytes in front, little endian; a header is a message of fields `key=value`, each with a length.
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import struct
import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1.description import MAX_MESSAGE_BYTES

LENGTH = struct.Struct("<I")
MAX_HEADER_BYTES = 1 << 20
_CHUNK = 1 << 16


class PeerLost(Exception):
    """The connection ended, or its deadline passed (`timed_out`)."""

    def __init__(self, reason: str, *, timed_out: bool = False) -> None:
        super().__init__(reason)
        self.timed_out = timed_out


def failure_reason(error: BaseException) -> str:
    """Why the system refused, without its number."""
    if isinstance(error, OSError) and error.errno and not isinstance(error, socket.gaierror):
        return os.strerror(error.errno)
    return (isinstance(error, OSError) and error.strerror) or str(error) or "connection failed"


def encode_header(fields: Mapping[str, str]) -> bytes:
    """A header with its length."""
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(LENGTH.pack(len(line)) + line for line in lines)
    return LENGTH.pack(len(body)) + body


def parse_header(data: bytes) -> dict[str, str]:
    """The fields of a header without its length. Raises `MalformedMessage`."""
    fields, at = {}, 0
    while at < len(data):
        if at + 4 > len(data):
            raise MalformedMessage("the header ends within a length", "", at)
        (size,) = LENGTH.unpack_from(data, at)
        line = data[at + 4 : at + 4 + size]
        if len(line) < size:
            what = f"a field of {size} bytes, {len(line)} are left in the header"
            raise MalformedMessage(what, "", at)
        key, equals, value = line.partition(b"=")
        if not equals:
            raise MalformedMessage(f"the header field `{line[:40]!r}` has no `=`", "", at + 4)
        fields[key.decode(errors="replace")] = value.decode(errors="replace")
        at += 4 + size
    return fields


def connect(host: str, number: int, timeout: float) -> TcprosStream:
    """A connection to host and TCP port. Raises `PeerLost`."""
    try:
        opened = socket.create_connection((host, number), timeout)
    except (OSError, UnicodeError, OverflowError) as error:
        timed_out = isinstance(error, TimeoutError)
        raise PeerLost(failure_reason(error), timed_out=timed_out) from None
    return TcprosStream(opened)


class TcprosStream:
    """One connection. `deadline` is a time of `time.monotonic`, None for no limit.

    `bytes_in` and `bytes_out` count what travelled.
    """

    def __init__(self, opened: socket.socket) -> None:
        self.socket = opened
        self.deadline: float | None = None
        self.bytes_in = self.bytes_out = 0
        self._buffer = b""
        self._at = 0
        self._poll = select.poll()
        self._poll.register(opened, select.POLLIN)
        with contextlib.suppress(OSError):
            opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            opened.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        opened.settimeout(None)

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
            received = self.socket.recv(_CHUNK) if into is None else self.socket.recv_into(into)
        except (OSError, ValueError) as error:
            timed_out = isinstance(error, TimeoutError)
            raise PeerLost(failure_reason(error), timed_out=timed_out) from None
        if not received:
            raise PeerLost("the peer closed the connection")
        return received

    def take(self, size: int) -> bytes | memoryview:
        """The next `size` bytes; many are received into their place. Raises `PeerLost`."""
        at = self._at
        end = at + size
        if end > len(self._buffer):
            if size > _CHUNK:
                return self._take_large(size)
            self._buffer = self._buffer[at:]
            at, end = 0, size
            while len(self._buffer) < size:
                data = self._receive()
                self._buffer = self._buffer + data if self._buffer else data
        self._at = end
        self.bytes_in += size
        return self._buffer[at:end]

    def _take_large(self, size: int) -> memoryview:
        try:
            target = np.empty(size, np.uint8).data
        except MemoryError:
            raise PeerLost(f"there is no memory for a message of {size} bytes") from None
        filled = len(self._buffer) - self._at
        target[:filled] = self._buffer[self._at :]
        self._buffer, self._at = b"", 0
        while filled < size:
            filled += self._receive(target[filled:])
        self.bytes_in += size
        return target.toreadonly()

    def frame(self, limit: int = MAX_MESSAGE_BYTES) -> bytes | memoryview:
        """The next message. Raises `PeerLost`, and `MalformedMessage` if it is too long."""
        (size,) = LENGTH.unpack(self.take(4))
        if size > limit:
            raise MalformedMessage(f"a message of {size} bytes, at most {limit} are accepted")
        return self.take(size)

    def header(self) -> dict[str, str]:
        """The header of the peer. Raises `PeerLost` and `MalformedMessage`."""
        return parse_header(bytes(self.frame(MAX_HEADER_BYTES)))

    def send(self, *buffers: Any) -> None:
        """Send all bytes. Raises `PeerLost`."""
        try:
            self._limit()
            rest = self._rest(buffers, self.socket.sendmsg(buffers))
            if rest:
                self.socket.sendall(rest)
        except (OSError, ValueError) as error:
            timed_out = isinstance(error, TimeoutError)
            raise PeerLost(failure_reason(error), timed_out=timed_out) from None
        self.bytes_out += sum(map(len, buffers))

    def send_now(self, buffers: tuple[Any, ...]) -> memoryview:
        """Send what the system takes at once; returns the rest. Raises `OSError`."""
        try:
            sent = self.socket.sendmsg(buffers, (), socket.MSG_DONTWAIT)
        except BlockingIOError:
            sent = 0
        self.bytes_out += sent
        return self._rest(buffers, sent)

    @staticmethod
    def _rest(buffers: tuple[Any, ...], sent: int) -> memoryview:
        """What was not sent; without a copy if only a part of the last buffer is left."""
        for index, buffer in enumerate(buffers):
            if sent < len(buffer):
                if index == len(buffers) - 1:
                    return memoryview(buffer)[sent:]
                tail = [memoryview(buffer)[sent:], *buffers[index + 1 :]]
                return memoryview(b"".join(tail))
            sent -= len(buffer)
        return memoryview(b"")

    def is_closed(self) -> bool:
        """Whether the peer has closed the connection; never blocks."""
        try:
            if not self._poll.poll(0):
                return False
            return self.socket.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT) == b""
        except BlockingIOError:
            return False
        except (OSError, ValueError):
            return True

    def close(self) -> None:
        """End the connection; a thread that reads it gets `PeerLost`."""
        with contextlib.suppress(OSError):
            self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()
