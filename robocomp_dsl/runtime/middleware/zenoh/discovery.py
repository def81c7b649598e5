"""Discovery of processes of one user on one machine: a folder of sockets per domain.

In: a domain. Out: an open zenoh session that is connected to every live process of the domain. Each
process listens on a socket in the folder `robocomp-<uid>/<domain>` of the user's runtime directory
and connects to all existing sockets at its start; a lock serialises the starts, so none is missed.
Only the user can access the folder. There is no multicast and no TCP port, unless a port is
requested, which is bound to loopback.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import socket
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import zenoh

from robocomp_dsl.runtime.errors import MiddlewareError

_LOCK = "lock"
_WAIT_BEFORE_DROP_US = "transport/link/tx/queue/congestion_control/drop/wait_before_drop"
MAX_SOCKET_PATH = 100
"""A socket path is limited to 108 bytes, and zenoh appends `.lock`."""


@dataclass(frozen=True, slots=True)
class DomainSession:
    """A session and the socket that it listens on."""

    session: zenoh.Session
    socket: Path

    def close(self) -> None:
        """Close the session and delete the socket; the last process also deletes the folder."""
        # Closing twice, or after the peer has exited, is allowed.
        with contextlib.suppress(zenoh.ZError):
            self.session.close()
        folder = self.socket.parent
        with contextlib.suppress(OSError), _folder_lock(folder):
            _remove(self.socket)
            # `_live_sockets` also deletes the sockets of killed processes.
            if not list(_live_sockets(folder)) and [p.name for p in folder.iterdir()] == [_LOCK]:
                (folder / _LOCK).unlink()
                folder.rmdir()


def open_session(domain: str, port: int = 0, *, hold_s: float = 0.0) -> DomainSession:
    """Open a session in `domain`, which also listens on TCP `port` of loopback if not 0.

    `hold_s`: how long a peer that receives nothing may hold a publication; 0: the default of zenoh.

    Raises `MiddlewareError` if the folder or the port cannot be used.
    """
    folder = _domain_folder(domain)
    with _folder_lock(folder):
        others = [f"unixsock-stream/{path}" for path in _live_sockets(folder)]
        mine = _unused_socket(folder)
        listen = [f"unixsock-stream/{mine}"]
        if port:
            _check_port_free(port)
            listen.append(f"tcp/127.0.0.1:{port}")
        try:
            config = _config(listen, others)
            if hold_s:
                config.insert_json5(_WAIT_BEFORE_DROP_US, str(round(hold_s * 1e6)))
            return DomainSession(zenoh.open(config), mine)
        except zenoh.ZError as error:
            raise MiddlewareError(f"zenoh cannot listen at {', '.join(listen)}: {error}") from None


def _config(listen: list[str], connect: list[str]) -> zenoh.Config:
    config = zenoh.Config()
    settings: dict[str, Any] = {
        "mode": "peer",
        "listen/endpoints": listen,
        "connect/endpoints": connect,
        # All listed peers are alive; one that exits right now must not delay the start.
        "connect/timeout_ms": 0,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config


def _domain_folder(domain: str) -> Path:
    base = Path(os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir())
    plain = domain if domain.replace("-", "").replace("_", "").isalnum() else ""
    name = (
        plain if 0 < len(plain) <= 24 else f"{plain[:15]}{sha256(domain.encode()).hexdigest()[:8]}"
    )
    folder = base / f"robocomp-{os.getuid()}" / name
    if len(str(folder)) + 20 > MAX_SOCKET_PATH:
        folder = Path(tempfile.gettempdir()) / f"robocomp-{os.getuid()}" / name
    try:
        folder.parent.mkdir(mode=0o700, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        owner = folder.parent.stat()
    except OSError as error:
        raise MiddlewareError(f"cannot use {folder} to find other components: {error}") from None
    if owner.st_uid != os.getuid() or owner.st_mode & 0o077:
        raise MiddlewareError(f"{folder.parent} belongs to, or is open to, other users")
    return folder


@contextlib.contextmanager
def _folder_lock(folder: Path) -> Iterator[None]:
    """Hold the lock of the folder; the kernel releases the lock of a killed process."""
    lock = _acquire_lock(folder)
    while lock is None:
        lock = _acquire_lock(folder)
    try:
        yield
    finally:
        os.close(lock)


def _acquire_lock(folder: Path) -> int | None:
    """The lock; None if the previous holder deleted the folder in the meantime."""
    folder.mkdir(mode=0o700, exist_ok=True)
    try:
        lock = os.open(folder / _LOCK, os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o600)
    except FileNotFoundError:
        return None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if os.path.samestat(os.fstat(lock), (folder / _LOCK).stat()):
            return lock
    except FileNotFoundError:
        pass
    os.close(lock)
    return None


def _unused_socket(folder: Path) -> Path:
    number = 0
    while (path := folder / f"{os.getpid()}-{number}").exists():
        number += 1
    return path


def _live_sockets(folder: Path) -> Iterator[Path]:
    """Sockets with a listening process; deletes those of killed processes."""
    for path in sorted(folder.iterdir()):
        if not path.is_socket():
            continue
        with socket.socket(socket.AF_UNIX) as probe:
            try:
                probe.connect(str(path))
            except OSError:
                _remove(path)
            else:
                yield path


def _remove(path: Path) -> None:
    for file in (path, path.with_name(f"{path.name}.lock")):
        file.unlink(missing_ok=True)


def _check_port_free(port: int) -> None:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError as error:
            raise MiddlewareError(
                f"port {port} cannot be used: {error.strerror}; use another port, or none"
            ) from None
