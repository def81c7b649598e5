"""Closes a zenoh session within a moment, also beside peers that hang.

In: a session and its sockets. Out: it is closed. zenoh waits for attempts to connect until they
time out. This module ends them earlier: it shuts down the sockets of this process that belong to
the session and have no established link.
"""

from __future__ import annotations

import contextlib
import os
import socket
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import zenoh

_GRACE_S = 0.05
"""A session without pending attempts closes, and sends what is queued, within a few ms."""
_PERIOD_S = 0.01
_MAX_PERIOD_S = 0.2
"""Each look at all sockets doubles the time to the next one: many processes may stop together."""
_DEADLINE_S = 5.0
_DESCRIPTORS = (Path("/proc/self/fd"), Path("/dev/fd"))
_UNIX_SOCKET = "unixsock-stream/"


def close_session(session: zenoh.Session, own: Path, port: int = 0) -> None:
    """Close the session that listens at the socket `own` and at TCP `port` of loopback if not 0.

    Closing twice, or after the peers have exited, is allowed.
    """
    linked = _linked_sockets(session)
    closing = _start_closing(session)
    closing.join(_GRACE_S)
    deadline = time.monotonic() + _DEADLINE_S
    period = _PERIOD_S
    while closing.is_alive() and time.monotonic() < deadline:
        _shut_down_pending(own, port, linked)
        closing.join(period)
        period = min(2 * period, _MAX_PERIOD_S)


def close_client_session(session: zenoh.Session) -> None:
    """Close a session that listens nowhere; its router may be away, or hang."""
    _start_closing(session).join(_DEADLINE_S)


def _start_closing(session: zenoh.Session) -> threading.Thread:
    # Not a daemon: a thread that leaves zenoh while the interpreter ends would abort the process.
    closing = threading.Thread(target=_close, args=(session,), name="zenoh.close", daemon=False)
    closing.start()
    return closing


def _close(session: zenoh.Session) -> None:
    with contextlib.suppress(zenoh.ZError):
        session.close()


def _linked_sockets(session: zenoh.Session) -> frozenset[str]:
    """The sockets of the peers to which the session has established links."""
    try:
        links = session.info.links()
    except zenoh.ZError:  # closed before
        return frozenset()
    return frozenset(str(link.dst).removeprefix(_UNIX_SOCKET) for link in links)


def _shut_down_pending(own: Path, port: int, linked: frozenset[str]) -> None:
    """Shut down connections to other members without a link, and those that this one accepted."""
    for connection in _sockets():
        with connection, contextlib.suppress(OSError):
            local, peer = connection.getsockname(), connection.getpeername()
            accepted = local == str(own) or (port and local == ("127.0.0.1", port))
            pending = _is_beside(own, peer) and peer not in linked
            if accepted or pending:
                connection.shutdown(socket.SHUT_RDWR)


def _is_beside(own: Path, address: object) -> bool:
    return isinstance(address, str) and os.path.dirname(address) == str(own.parent)  # noqa: PTH120 - no path may be invalid


def _sockets() -> Iterator[socket.socket]:
    """Duplicates of all sockets of this process."""
    folder = next((path for path in _DESCRIPTORS if path.is_dir()), None)
    for name in os.listdir(folder) if folder else ():  # noqa: PTH208 - short-lived entries
        with contextlib.suppress(OSError):  # closed by another thread in the meantime
            descriptor = os.dup(int(name))
            try:
                yield socket.socket(fileno=descriptor)
            except OSError:  # another kind of file
                os.close(descriptor)
