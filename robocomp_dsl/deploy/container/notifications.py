"""Receives sd_notify(3) messages of the program in a container. Standard library only.

In: datagrams at a Unix socket. Out: the latest assignments: `READY`, `WATCHDOG`, `STATUS`.
"""

from __future__ import annotations

import contextlib
import os
import socket
from pathlib import Path

_MAX_BYTES = 4096


class Notifications:
    """A socket at `path` until `close`."""

    def __init__(self, path: Path) -> None:
        path.unlink(missing_ok=True)
        self.address = str(path)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC)
        self._socket.bind(self.address)
        path.chmod(0o600)
        self._socket.setblocking(False)

    def fileno(self) -> int:
        """The descriptor, for select."""
        return self._socket.fileno()

    def read(self) -> dict[str, str]:
        """The assignments of all messages that have arrived; later ones win."""
        assignments: dict[str, str] = {}
        while True:
            try:
                text = self._socket.recv(_MAX_BYTES).decode("utf-8", "replace")
            except OSError:
                return assignments
            for line in text.splitlines():
                name, equals, value = line.partition("=")
                if equals:
                    assignments[name] = value

    def close(self) -> None:
        """Stop listening."""
        self._socket.close()
        with contextlib.suppress(OSError):
            os.unlink(self.address)  # noqa: PTH108 - a path as text
