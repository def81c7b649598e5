"""Messages on a unix socket: 4 bytes length, 1 byte length of the name, name, payload."""

from __future__ import annotations

import contextlib
import os
import socket
import struct
import threading
import uuid
from collections.abc import Callable

MAX_BYTES = 1 << 30
_HEADER = struct.Struct("<IB")
_CREDENTIALS = struct.Struct("3i")


class InvalidFrame(Exception):
    """What arrived is no message."""


def send(connection: socket.socket, name: bytes, *parts: bytes) -> None:
    """Send a message. Raises `OSError`."""
    length = sum(map(len, parts))
    connection.sendall(_HEADER.pack(length, len(name)) + name)
    for part in parts:
        connection.sendall(part)


def receive(connection: socket.socket) -> tuple[str, bytes]:
    """The next message. Raises `EOFError` at the end, `OSError` and `InvalidFrame`."""
    length, name_length = _HEADER.unpack(_read(connection, _HEADER.size))
    if length > MAX_BYTES:
        raise InvalidFrame(f"a message of {length} bytes")
    name = _read(connection, name_length).decode(errors="replace")
    return name, _read(connection, length)


def _read(connection: socket.socket, count: int) -> bytes:
    data = memoryview(bytearray(count))
    at = 0
    while at < count:
        received = connection.recv_into(data[at:])
        if not received:
            raise EOFError
        at += received
    return bytes(data)


def connect(address: str, timeout: float | None) -> socket.socket:
    """A connection to a `Listener`. Raises `OSError`."""
    connection = socket.socket(socket.AF_UNIX)
    try:
        connection.settimeout(timeout)
        connection.connect(f"\0{address}")
    except OSError:
        connection.close()
        raise
    return connection


def shut_down(connection: socket.socket) -> None:
    """End all threads that wait for the socket."""
    with contextlib.suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)


class Listener:
    """Accepts connections of this user, and runs `handle` in a thread for each."""

    def __init__(self, name: str, handle: Callable[[socket.socket], None]) -> None:
        self.address = f"robocomp-pipe-{uuid.uuid4().hex}"
        self._name = name
        self._handle = handle
        self._open: set[socket.socket] = set()
        self._lock = threading.Lock()
        self._closed = False
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.bind(f"\0{self.address}")
        self._socket.listen(512)
        threading.Thread(target=self._accept, name=name, daemon=True).start()

    def _accept(self) -> None:
        while not self._closed:
            with contextlib.suppress(OSError):
                connection, _ = self._socket.accept()
                with self._lock:
                    self._open.add(connection)
                threading.Thread(
                    target=self._run, args=(connection,), name=self._name, daemon=True
                ).start()
        self._socket.close()

    def _run(self, connection: socket.socket) -> None:
        with connection, contextlib.suppress(OSError, EOFError, InvalidFrame):
            if not self._closed and _user_of(connection) == os.getuid():
                self._handle(connection)
        with self._lock:
            self._open.discard(connection)

    def close(self) -> None:
        """Accept no further connection, and end those that are open."""
        self._closed = True
        shut_down(self._socket)
        with self._lock:
            for connection in self._open:
                shut_down(connection)


def _user_of(connection: socket.socket) -> int:
    data = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, _CREDENTIALS.size)
    user: int = _CREDENTIALS.unpack(data)[1]
    return user
