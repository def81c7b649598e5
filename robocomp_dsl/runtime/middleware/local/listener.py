"""Accepts the connections of all ports of a component, in one thread.

In: a socket file, and ports. Out: connections of this user's processes that have said which port
and which version of its interface they mean; each is passed to its port.
"""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import select
import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket
from robocomp_dsl.runtime.middleware.local.ports import Hello, make_address, parse_hello
from robocomp_dsl.runtime.middleware.local.socket_file import SocketFile

MAX_SILENT = 64
"""Connections that have not said anything; of more, the oldest is closed."""
REPLY_TIMEOUT_S = 1.0
"""How long a peer that takes no replies may hold the thread of its own connection."""
_PAUSE_S = 0.05
log = logging.getLogger("robocomp")


class AcceptingPort(Protocol):
    """A port that connections are passed to."""

    kind: int
    depth: int
    hash: bytes
    name: str

    def accept(self, accepted: socket.socket, hello: Hello) -> None:
        """Receive from a connection."""


class Listener:
    """The socket of a component and its thread, started with the first port."""

    def __init__(self, folder: Path, fail: Callable[[str], None]) -> None:
        self._folder = folder
        self._fail = fail
        self._file: SocketFile | None = None
        self._thread: threading.Thread | None = None
        self._ports: dict[int, AcceptingPort] = {}
        self._number = 0
        self._lock = threading.Lock()
        self._closed = False
        self._silent: dict[int, socket.socket] = {}
        self._throttle = Throttle()
        self.rejected = 0

    def add(self, port: AcceptingPort) -> str:
        """Accept connections for a port; returns its address. Raises `MiddlewareError`."""
        with self._lock:
            if self._file is None:
                self._file = SocketFile(self._folder)
                self._thread = threading.Thread(target=self._run, name="local", daemon=True)
                self._thread.start()
            self._number += 1
            self._ports[self._number] = port
            return make_address(str(self._file.path), self._number)

    def remove(self, port: AcceptingPort) -> None:
        """Accept no more connections for a port."""
        with self._lock:
            self._ports = {n: p for n, p in self._ports.items() if p is not port}

    def close(self) -> None:
        """Accept no more connections, and delete the socket."""
        with self._lock:
            self._closed = True
            if self._file:
                self._file.close()
        if self._thread and self._thread is not threading.current_thread():
            self._thread.join(1.0)

    def _run(self) -> None:
        assert self._file  # noqa: S101 - set before the thread is started
        listening = self._file.socket
        try:
            self._accept_all(listening)
        except BaseException as error:
            self._fail(f"the thread that accepts connections died: {describe_error(error)}")
        finally:
            for opened in (listening, *self._silent.values()):
                opened.close()

    def _accept_all(self, listening: socket.socket) -> None:
        poll = select.poll()
        poll.register(listening, select.POLLIN)
        while not self._closed:
            for descriptor, _ in poll.poll():
                if descriptor == listening.fileno():
                    self._accept(listening, poll)
                elif opened := self._silent.pop(descriptor, None):
                    poll.unregister(opened)
                    self._greet(opened)

    def _accept(self, listening: socket.socket, poll: select.poll) -> None:
        try:
            accepted, _ = listening.accept()
        except OSError as error:
            if error.errno in (errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.ENOBUFS):
                self._warn(f"cannot accept connections: {os.strerror(error.errno)}")
                time.sleep(_PAUSE_S)
            return
        packets.limit_waits(accepted, REPLY_TIMEOUT_S, 0)
        if not packets.is_same_user(accepted):
            self._reject(accepted, "a connection of another user was rejected")
            return
        if len(self._silent) >= MAX_SILENT:
            oldest = self._silent.pop(next(iter(self._silent)))
            poll.unregister(oldest)
            self._reject(oldest, "a connection without a greeting was closed")
        self._silent[accepted.fileno()] = accepted
        poll.register(accepted, select.POLLIN)

    def _greet(self, accepted: socket.socket) -> None:
        """Read the first packet of a connection, and pass it to its port."""
        try:
            hello = parse_hello(packets.receive_plain(accepted))
            port = self._ports.get(hello.port)
            if port is None:
                accepted.close()  # the port was closed: the peer sees that it is lost
            elif port.hash != hello.hash or port.kind != hello.kind:
                text = f"{hello.name} and {port.name} were generated from different versions"
                head = packets.HEAD.pack(packets.REFUSED, 0, 0)
                accepted.send(head + text.encode(), socket.MSG_DONTWAIT)
                accepted.close()
            else:
                head = packets.HEAD.pack(packets.READY, 0, 0)
                with contextlib.suppress(OSError):  # it has sent everything, and closed
                    accepted.send(head + packets.DEPTH.pack(port.depth), socket.MSG_DONTWAIT)
                port.accept(accepted, hello)
        except MalformedPacket as error:
            self._reject(accepted, f"rejected {error}")
        except (OSError, RuntimeError) as error:  # it has closed, or no thread can be started
            accepted.close()
            if isinstance(error, RuntimeError):
                self._warn(f"a connection was closed: {error}")

    def _reject(self, accepted: socket.socket, text: str) -> None:
        accepted.close()
        self.rejected += 1
        self._warn(text)

    def _warn(self, text: str) -> None:
        with contextlib.suppress(Exception):
            if self._throttle.allows(text):
                log.warning("%s", text)
