"""Locks on files that the kernel releases when the process ends, however it ends.

In: a path. Out: a lock, or None if another process holds it. A forked child does not hold the locks
of its parent, so a killed parent is never taken for a running one.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import time
import weakref
from pathlib import Path

_PERIOD_S = 0.002


class FileLock:
    """The exclusive lock on one file, held until `release` or the end of the process."""

    def __init__(self, path: Path, descriptor: int) -> None:
        self.path = path
        self._descriptor = descriptor
        _held.add(self)

    def write(self, text: str) -> None:
        """Replace the content of the file."""
        data = text.encode()
        os.pwrite(self._descriptor, data, 0)
        os.ftruncate(self._descriptor, len(data))

    def release(self, *, delete: bool = False) -> None:
        """Release the lock; with `delete`, delete the file first."""
        if self._descriptor < 0:
            return
        if delete:
            self.path.unlink(missing_ok=True)
        # A child process between fork and exec has a copy of the descriptor, too.
        fcntl.flock(self._descriptor, fcntl.LOCK_UN)
        self.close()

    def close(self) -> None:
        """Close this copy of the descriptor; a parent process keeps the lock."""
        descriptor, self._descriptor = self._descriptor, -1
        if descriptor >= 0:
            os.close(descriptor)


_held: weakref.WeakSet[FileLock] = weakref.WeakSet()


def _close_in_child() -> None:
    for lock in list(_held):
        with contextlib.suppress(OSError):
            lock.close()


os.register_at_fork(after_in_child=_close_in_child)


def try_lock(path: Path) -> FileLock | None:
    """The lock on `path`, which is created if missing; None if another process holds it.

    Raises `OSError`, and `FileNotFoundError` without a folder.
    """
    while True:
        descriptor = os.open(path, os.O_CREAT | os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW, 0o600)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            current = _is_current(descriptor, path)
        except BlockingIOError:
            os.close(descriptor)
            return None
        except BaseException:
            os.close(descriptor)
            raise
        if current:
            return FileLock(path, descriptor)
        os.close(descriptor)  # the previous holder deleted the file in the meantime


def wait_for_lock(path: Path, timeout_s: float) -> FileLock | None:
    """The lock on `path`; None if it is not free within `timeout_s` seconds. As `try_lock`."""
    deadline = time.monotonic() + timeout_s
    while (lock := try_lock(path)) is None and time.monotonic() < deadline:
        time.sleep(_PERIOD_S)
    return lock


def _is_current(descriptor: int, path: Path) -> bool:
    """Whether the open file is still the one at `path`."""
    try:
        return os.path.samestat(os.fstat(descriptor), path.lstat())
    except FileNotFoundError:
        return False
