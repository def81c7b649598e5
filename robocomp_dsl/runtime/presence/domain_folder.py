"""The folder of a domain: who is in it, as sockets and locked files. Opens no connection.

In: a domain. Out: a place for the socket of this process, and the sockets of the members before it.

    <ticket>-<pid>          the socket of a member
    <ticket>-<pid>.member   locked by it; the lock of a killed process is free, whatever its socket
                            does
    lock                    lets starts take turns

Of two members, the one with the higher ticket connects to the other. A member lists the others
after it has taken its ticket, and takes another one if its own is not the highest then. So exactly
one of two knows the other, even without the lock, which only saves attempts: it is held for file
operations, never while connecting, and a process that was stopped while it held the lock delays
others by `LOCK_TIMEOUT_S`.
"""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from robocomp_dsl.runtime.file_lock import FileLock, try_lock, wait_for_lock
from robocomp_dsl.runtime.presence.stale_sockets import sweep_sockets
from robocomp_dsl.runtime.private_folder import (
    UnsafeFolder,
    private_folder,
    user_folder,
)

LOCK_TIMEOUT_S = 0.2
MAX_SOCKET_PATH = 100
"""A socket path is limited to 108 bytes, and zenoh appends `.lock`."""
_LOCK = "lock"
_MEMBER = ".member"
_VALID = re.compile(r"[0-9]{1,18}-[0-9]{1,18}")
_NAMES = (".component", ".deployment")


@dataclass(frozen=True, slots=True)
class Membership:
    """The place of this process in a domain, until `leave`."""

    socket: Path
    _lock: FileLock

    def leave(self) -> None:
        """Delete the socket; the last member also deletes the folder."""
        folder = self.socket.parent
        with contextlib.suppress(OSError), folder_lock(folder) as locked:
            _remove_socket(self.socket)
            self._lock.release(delete=True)
            if locked:
                _delete_if_unused(folder)
        self._lock.release(delete=True)


def domain_path(domain: str) -> Path:
    """The folder of a domain. Raises `UnsafeFolder` if the user's folder cannot be used."""
    plain = domain if domain.replace("-", "").replace("_", "").isalnum() else ""
    digest = sha256(domain.encode()).hexdigest()[:8]
    name = plain if 0 < len(plain) <= 24 else f"{plain[:15]}{digest}"
    folder = user_folder() / name
    if len(os.fsencode(folder)) + 20 > MAX_SOCKET_PATH:
        folder = private_folder(Path(tempfile.gettempdir()) / f"robocomp-{os.getuid()}") / name
    return folder


def domain_folder(domain: str) -> Path:
    """The folder of a domain, created if missing. Raises `UnsafeFolder`."""
    return private_folder(domain_path(domain))


def join(domain: str) -> tuple[Membership, list[Path]]:
    """Take a place in a domain; returns it, and the sockets of all members before.

    A socket of the list may start to listen later. Raises `UnsafeFolder`.
    """
    while True:
        folder = domain_folder(domain)
        try:
            with folder_lock(folder):
                return _take_place(folder)
        except FileNotFoundError:
            continue  # the last member has just deleted the folder
        except OSError as error:
            raise UnsafeFolder(f"{folder} cannot be used: {error.strerror or error}") from None


@contextlib.contextmanager
def folder_lock(folder: Path) -> Iterator[bool]:
    """Hold the lock of the folder; yields whether it is held.

    It is not held if its holder has been stopped.
    """
    lock = wait_for_lock(folder / _LOCK, LOCK_TIMEOUT_S)
    try:
        yield lock is not None
    finally:
        if lock:
            lock.release()


def _take_place(folder: Path) -> tuple[Membership, list[Path]]:
    while True:
        members = list(_sweep(folder))
        ticket = max(map(_order, members), default=(0, 0))[0] + 1
        path = folder / f"{ticket}-{os.getpid()}"
        lock = try_lock(_member_file(path))
        if lock is None:  # another thread of this process has just taken it
            continue
        others = [member for member in _sweep(folder) if member != path]
        if all(_order(member) < _order(path) for member in others):
            _remove_socket(path)
            return Membership(path, lock), others
        lock.release(delete=True)


def _order(member: Path) -> tuple[int, int]:
    """Ticket and process of a member; members are compared by it."""
    ticket, _, pid = member.name.partition("-")
    return int(ticket), int(pid)


def _member_file(path: Path) -> Path:
    return path.with_name(f"{path.name}{_MEMBER}")


def _sweep(folder: Path) -> Iterator[Path]:
    """The sockets of all members; deletes what killed processes left."""
    for path in sorted(folder.iterdir()):
        if path.suffix == _MEMBER and _VALID.fullmatch(path.stem):
            if lock := try_lock(path):
                _remove_socket(path.with_suffix(""))
                lock.release(delete=True)
            else:
                yield path.with_suffix("")
        elif path.is_socket() and not _member_file(path).exists():
            _remove_socket(path)


def delete_if_unused(folder: Path) -> None:
    """Delete the folder if no process uses it."""
    with contextlib.suppress(OSError), folder_lock(folder) as locked:
        if locked:
            _delete_if_unused(folder)


def _delete_if_unused(folder: Path) -> None:
    if any(_sweep(folder)):
        return
    for path in folder.iterdir():
        if path.suffix in _NAMES and (lock := try_lock(path)):
            lock.release(delete=True)
        elif path.is_dir():  # the folder of a middleware
            sweep_sockets(path)
            path.rmdir()
    if {path.name for path in folder.iterdir()} <= {_LOCK}:
        (folder / _LOCK).unlink(missing_ok=True)
        folder.rmdir()


def _remove_socket(path: Path) -> None:
    for file in (path, path.with_name(f"{path.name}.lock")):
        file.unlink(missing_ok=True)
