"""Socket files of components in the folder of this middleware in a domain.

    <pid>-<random>          the socket; a restarted component has another address
    <pid>-<random>.lock     locked by its owner; the lock of a killed process is free

In: a folder. Out: a listening socket. Sockets that killed processes left are deleted on the way.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import socket
from pathlib import Path

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.file_lock import FileLock, try_lock
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.presence.stale_sockets import LOCK_SUFFIX, sweep_sockets
from robocomp_dsl.runtime.private_folder import UnsafeFolder, private_folder

BACKLOG = 128


class SocketFile:
    """A listening socket with its file, until `close`."""

    def __init__(self, folder: Path) -> None:
        """Create it. Raises `MiddlewareError`."""
        try:
            sweep_sockets(private_folder(folder))
            self.path, self._lock = _claim(folder)
            self.socket = packets.new_socket(0)
            self.socket.bind(str(self.path))
            self.socket.listen(BACKLOG)
        except UnsafeFolder as error:
            raise MiddlewareError(str(error)) from None
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
    """A path that no other component has or had."""
    while True:
        path = folder / f"{os.getpid()}-{secrets.token_hex(4)}"
        if lock := try_lock(path.with_name(path.name + LOCK_SUFFIX)):
            return path, lock
