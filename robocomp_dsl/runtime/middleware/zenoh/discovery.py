"""How processes of one user on one machine find each other: a folder of sockets per domain.

In: a domain. Out: an open zenoh session that is connected to every living process of the domain.
Each process listens on a socket in the folder `robocomp-<uid>/<domain>` of the user's runtime
directory and, when it starts, connects to all that are there; a lock lets them start one after the
other, so none is missed. Only the user can enter the folder. There is no multicast and no port,
unless one was asked for, and that one is on loopback.
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
LONGEST_SOCKET = 100
"""A socket's path has room for 108 bytes, and zenoh adds `.lock` to it."""


@dataclass(frozen=True, slots=True)
class Opened:
    """A session and the socket that it listens on."""

    session: zenoh.Session
    socket: Path

    def close(self) -> None:
        """End the session and take the socket away; the last one takes the folder away, too."""
        # Closing twice, or after the peer is gone, is no failure.
        with contextlib.suppress(zenoh.ZError):
            self.session.close()
        folder = self.socket.parent
        with contextlib.suppress(OSError), _one_at_a_time(folder):
            _remove(self.socket)
            # Looking who lives also sweeps what killed processes left.
            if not list(_living(folder)) and [p.name for p in folder.iterdir()] == [_LOCK]:
                (folder / _LOCK).unlink()
                folder.rmdir()


def open_session(domain: str, port: int = 0) -> Opened:
    """A session in `domain`, listening also at `port` on loopback if that is not 0.

    Raises `MiddlewareError` when the folder or the port cannot be used.
    """
    folder = _folder(domain)
    with _one_at_a_time(folder):
        others = [f"unixsock-stream/{path}" for path in _living(folder)]
        mine = _free_name(folder)
        listen = [f"unixsock-stream/{mine}"]
        if port:
            _must_be_free(port)
            listen.append(f"tcp/127.0.0.1:{port}")
        try:
            return Opened(zenoh.open(_config(listen, others)), mine)
        except zenoh.ZError as error:
            raise MiddlewareError(f"zenoh cannot listen at {', '.join(listen)}: {error}") from None


def _config(listen: list[str], connect: list[str]) -> zenoh.Config:
    config = zenoh.Config()
    settings: dict[str, Any] = {
        "mode": "peer",
        "listen/endpoints": listen,
        "connect/endpoints": connect,
        # All that are listed are alive; one that ends just now must not hold up the start.
        "connect/timeout_ms": 0,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config


def _folder(domain: str) -> Path:
    base = Path(os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir())
    plain = domain if domain.replace("-", "").replace("_", "").isalnum() else ""
    name = (
        plain if 0 < len(plain) <= 24 else f"{plain[:15]}{sha256(domain.encode()).hexdigest()[:8]}"
    )
    folder = base / f"robocomp-{os.getuid()}" / name
    if len(str(folder)) + 20 > LONGEST_SOCKET:
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
def _one_at_a_time(folder: Path) -> Iterator[None]:
    """Hold the lock of the folder while it is looked at; the kernel frees that of the dead."""
    lock = _locked(folder)
    while lock is None:
        lock = _locked(folder)
    try:
        yield
    finally:
        os.close(lock)


def _locked(folder: Path) -> int | None:
    """The lock, or None when the one before took the folder away while this one waited."""
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


def _free_name(folder: Path) -> Path:
    number = 0
    while (path := folder / f"{os.getpid()}-{number}").exists():
        number += 1
    return path


def _living(folder: Path) -> Iterator[Path]:
    """Sockets that somebody listens on; the others are what killed processes left."""
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
    for one in (path, path.with_name(f"{path.name}.lock")):
        one.unlink(missing_ok=True)


def _must_be_free(port: int) -> None:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError as error:
            raise MiddlewareError(
                f"port {port} cannot be used: {error.strerror}; choose another, or none"
            ) from None
