"""Receives sd_notify(3) messages, with which any program reports its state to its supervisor.

In: datagrams on a Unix socket, whose address the programs get in `NOTIFY_SOCKET`. Out: the sender's
pid, which the kernel vouches for, and the assignments of the message: `READY=1`, `STATUS=…`,
`STOPPING=1`, `WATCHDOG=1`, `WATCHDOG_USEC=…`.
"""

from __future__ import annotations

import array
import asyncio
import os
import socket
import struct
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TypeAlias

SOCKET_VARIABLE = "NOTIFY_SOCKET"
WATCHDOG_VARIABLE = "WATCHDOG_USEC"
FOREIGN_VARIABLES = (SOCKET_VARIABLE, WATCHDOG_VARIABLE, "WATCHDOG_PID")
"""What a supervisor of rcdeploy itself may have set; it is not meant for the components."""
MAX_MESSAGE_BYTES = 4096
_MAX_DESCRIPTORS = 16
_CREDENTIALS = struct.Struct("3i")
"""pid, user and group of the sender (unix(7))."""
_MAX_ADDRESS_BYTES = 100

NotifyCallback: TypeAlias = Callable[[int, Mapping[str, str]], None]


class NotifySocket:
    """Listens until `close`; calls `on_message(pid, assignments)` in the event loop."""

    def __init__(self, folder: Path, on_message: NotifyCallback) -> None:
        path = folder / "notify"
        # A longer path does not fit into an address; senders are identified by their pid anyway.
        is_short = len(os.fsencode(path)) < _MAX_ADDRESS_BYTES
        self.address = str(path) if is_short else f"@robocomp-{os.getpid()}-{id(self):x}"
        self._on_message = on_message
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
        self._socket.setblocking(False)
        if is_short:
            path.unlink(missing_ok=True)
        self._socket.bind(self.address if is_short else f"\0{self.address[1:]}")
        self._loop = asyncio.get_running_loop()
        self._loop.add_reader(self._socket.fileno(), self._receive)

    def close(self) -> None:
        """Stop listening."""
        self._loop.remove_reader(self._socket.fileno())
        self._socket.close()
        if not self.address.startswith("@"):
            Path(self.address).unlink(missing_ok=True)

    def _receive(self) -> None:
        space = socket.CMSG_SPACE(_CREDENTIALS.size) + socket.CMSG_SPACE(_MAX_DESCRIPTORS * 4)
        try:
            data, ancillary, *_ = self._socket.recvmsg(
                MAX_MESSAGE_BYTES, space, socket.MSG_CMSG_CLOEXEC
            )
        except OSError:
            return
        pid = 0
        for level, kind, content in ancillary:
            if level != socket.SOL_SOCKET:
                continue
            if kind == socket.SCM_CREDENTIALS:
                pid = _CREDENTIALS.unpack(content)[0]
            elif kind == socket.SCM_RIGHTS:
                _close_all(content)
        if pid:
            self._on_message(pid, parse_message(data))


def parse_message(data: bytes) -> dict[str, str]:
    """The assignments of a message; lines that are none are ignored."""
    lines = data.decode("utf-8", "replace").splitlines()
    return dict(line.split("=", 1) for line in lines if "=" in line)


def watchdog_seconds(value: str) -> float:
    """The interval in s of a `WATCHDOG_USEC` (in µs); 0.0 if it is none."""
    return int(value) / 1e6 if value.isascii() and value.isdecimal() else 0.0


def _close_all(content: bytes) -> None:
    """Close received descriptors; for `BARRIER=1` this is the reply that the sender waits for."""
    descriptors = array.array("i")
    descriptors.frombytes(content[: len(content) - len(content) % descriptors.itemsize])
    for descriptor in descriptors:
        with suppress(OSError):
            os.close(descriptor)
