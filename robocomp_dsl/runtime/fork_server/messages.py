"""Messages between rcdeploy and its fork server: JSON objects, with open descriptors beside them.

In and out: a connected Unix socket of kind SEQPACKET, so a message is never split. Requests:
`{"start": N, "argv", "cwd", "env"}` with the descriptors of standard output, standard error and
heartbeat; `{"reap": PID}`. Replies: `{"ready": true}` once, `{"started": N, "pid"}` or
`{"started": N, "errno"}`, `{"reaped": PID, "code"}`.
"""

from __future__ import annotations

import array
import json
import os
import socket
from typing import Any

MAX_BYTES = 128 * 1024
"""Longer requests are not sent: a socket buffer takes at least that much."""
MAX_DESCRIPTORS = 3


def encode(message: dict[str, Any]) -> bytes:
    """A message as bytes."""
    return json.dumps(message, separators=(",", ":")).encode("utf-8", "surrogateescape")


def send(connection: socket.socket, message: dict[str, Any], *descriptors: int) -> None:
    """Send a message. Raises `OSError`, and `BlockingIOError` if it cannot be sent now."""
    rights = (socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", descriptors))
    connection.sendmsg([encode(message)], [rights] if descriptors else [])


def receive(connection: socket.socket) -> tuple[dict[str, Any], list[int]] | None:
    """The next message and its descriptors; None at the end. Raises `OSError`."""
    size = array.array("i").itemsize
    space = socket.CMSG_LEN(MAX_DESCRIPTORS * size)
    data, ancillary, *_ = connection.recvmsg(MAX_BYTES, space, socket.MSG_CMSG_CLOEXEC)
    descriptors: list[int] = []
    for level, kind, content in ancillary:
        if (level, kind) == (socket.SOL_SOCKET, socket.SCM_RIGHTS):
            numbers = array.array("i")
            numbers.frombytes(content[: len(content) // size * size])
            descriptors += numbers
    if not data:
        close_all(descriptors)
        return None
    message: dict[str, Any] = json.loads(data.decode("utf-8", "surrogateescape"))
    return message, descriptors


def close_all(descriptors: list[int]) -> None:
    """Close descriptors."""
    for descriptor in descriptors:
        os.close(descriptor)
