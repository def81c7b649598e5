"""Sockets that killed processes left in the folder of a middleware.

    NAME          the socket
    NAME.lock     locked by its owner; the kernel frees the lock when the process ends

In: a folder. Out: the folder without the sockets whose owners have ended.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.runtime.file_lock import try_lock

LOCK_SUFFIX = ".lock"


def sweep_sockets(folder: Path) -> None:
    """Delete the sockets of processes that have ended. Raises `OSError`."""
    for path in folder.glob(f"*{LOCK_SUFFIX}"):
        if lock := try_lock(path):
            path.with_suffix("").unlink(missing_ok=True)
            lock.release(delete=True)
