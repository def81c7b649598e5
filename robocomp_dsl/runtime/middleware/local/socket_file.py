"""Socket files of components in the folder of this middleware in a domain.

    <pid>-<n>          the socket
    <pid>-<n>.lock     locked by its owner; the lock of a killed process is free

In: a folder. Out: a listening socket. Sockets that killed processes left are deleted on the way.
"""

from __future__ import annotations

import contextlib
import itertools
import os
import socket
from pathlib import Path

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.file_lock import FileLock, try_lock
from robocomp_dsl.runtime.middleware.local import packets

BACKLOG = 128
_LOCK = ".lock"


class SocketFile:
    """A listening socket with its file, until `close`."""

    def __init__(self, folder: Path) -> None:
        """Create it. Raises `MiddlewareError`."""
        try:
            sweep(folder)
            self.path, self._lock = _claim(folder)
            self.socket = packets.new_socket(0)
            self.socket.bind(str(self.path))
            self.socket.listen(BACKLOG)
        except OSError as error:
            reason = error.strerror or error
            raise MiddlewareError(f"no socket can be created in {folder}: {reason}") from None

    def close(self) -> None:
        """Delete the file, and wake who waits for connections."""
        self.path.unlink(missing_ok=True)
        with contextlib.suppress(OSError):
            self._lock.release(delete=True)
        with contextlib.suppress(OSError):
            self.socket.shutdown(socket.SHUT_RDWR)


def _claim(folder: Path) -> tuple[Path, FileLock]:
    """A path of this process that no other of its components has."""
    for number in itertools.count():
        path = folder / f"{os.getpid()}-{number}"
        if lock := try_lock(path.with_name(path.name + _LOCK)):
            path.unlink(missing_ok=True)  # of a killed process with the same id
            return path, lock
    raise AssertionError


def sweep(folder: Path) -> None:
    """Delete the sockets of processes that have ended."""
    for path in folder.glob(f"*{_LOCK}"):
        if lock := try_lock(path):
            path.with_suffix("").unlink(missing_ok=True)
            lock.release(delete=True)
