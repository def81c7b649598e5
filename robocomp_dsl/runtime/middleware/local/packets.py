"""The packets of a connection: sockets of type SOCK_SEQPACKET, which keep their boundaries.

    head (4 bytes: kind, flags, index of the operation), then
    HELLO        HELLO_FORMAT, name of the peer         the first packet of each connection
    READY        depth of the receive queue             the answer to it; none of the next three
    REFUSED      text: why the connection is closed
    QUERY        request                                RESULT or FAILURE follows
    COMMAND      request
    PUBLICATION  number of the publication (16 bytes), request
    RESULT       reply
    FAILURE      error reply of `answers`

A body of more than `INLINE_BYTES` is in a memory file (`memory_pool`): the flag `SHARED` is set,
the packet has the size of the body in its place, and the descriptor of the file beside it. The
packet `ANNOUNCEMENT` precedes it, because to receive without descriptors is faster, and discards
those that nobody expects.
"""

from __future__ import annotations

import os
import socket
import struct
import weakref
from array import array
from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket, MappedFiles
from robocomp_dsl.runtime.middleware.local.memory_pool import SharedMessage

HELLO, READY, REFUSED, QUERY, COMMAND, PUBLICATION, RESULT, FAILURE = range(1, 9)
SHARED = 1
INLINE_BYTES = 1 << 16
HEAD = struct.Struct("<BBH")
HELLO_FORMAT = struct.Struct("<4s8sIB")
"""`MAGIC`, type hash of the interface, number of the port, and the kind of the sender."""
MAGIC = b"RCL1"
SIZE = struct.Struct("<Q")
DEPTH = struct.Struct("<I")
NUMBER_BYTES = 16
MAX_PACKET = INLINE_BYTES + 64
DESCRIPTOR_SPACE = socket.CMSG_SPACE(4)
MAX_NAME_BYTES = 512
ANNOUNCEMENT = b"\0"
_CUT = socket.MSG_TRUNC | socket.MSG_CTRUNC

Body: TypeAlias = bytes | memoryview
Received: TypeAlias = "bytes | SharedPacket"

_sockets: weakref.WeakSet[socket.socket] = weakref.WeakSet()


class SharedPacket:
    """A received packet whose body is a view of shared memory; `start` precedes the body."""

    __slots__ = ("body", "start")

    def __init__(self, start: bytes, body: Body) -> None:
        self.start = start
        self.body = body


def new_socket(timeout: float) -> socket.socket:
    """A blocking socket whose calls fail with `BlockingIOError` after `timeout` s."""
    opened = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    limit_waits(opened, timeout)
    return opened


def limit_waits(opened: socket.socket, send: float, receive: float | None = None) -> None:
    """Limit the waits of a blocking socket, in s; 0: no limit. One system call less than a poll."""
    _sockets.add(opened)
    for option, limit in (
        (socket.SO_SNDTIMEO, send),
        (socket.SO_RCVTIMEO, send if receive is None else receive),
    ):
        seconds, rest = divmod(limit, 1)
        opened.setsockopt(
            socket.SOL_SOCKET, option, struct.pack("ll", int(seconds), int(rest * 1e6))
        )


def _close_in_child() -> None:
    """A forked child holds no connection, so that the end of its parent is an end of file."""
    for opened in list(_sockets):
        opened.close()


os.register_at_fork(after_in_child=_close_in_child)


def is_same_user(peer: socket.socket) -> bool:
    """Whether the process on the other side belongs to this user."""
    credentials = peer.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12)
    _, user, _ = struct.unpack("iII", credentials)
    return bool(user == os.getuid())


def send(to: socket.socket, head: bytes, message: bytes | SharedMessage) -> int:
    """Send a packet with this head; returns the size of the message."""
    if isinstance(message, bytes):
        to.send(head + message)
        return len(message)
    send_shared(to, head, message)
    return message.size


def send_shared(to: socket.socket, start: bytes, message: SharedMessage) -> None:
    """Send a packet that begins with `start` and has its body in shared memory."""
    head = start[:1] + bytes((SHARED,)) + start[2:] + SIZE.pack(message.size)
    rights = (socket.SOL_SOCKET, socket.SCM_RIGHTS, array("i", (message.descriptor,)))
    to.send(ANNOUNCEMENT)
    to.sendmsg((head,), (rights,))


def receive(sender: socket.socket, files: MappedFiles, flags: int = 0) -> Received:
    """The next packet. Raises `MalformedPacket`, and `OSError` at the end of the connection."""
    try:
        data = sender.recv(MAX_PACKET, flags)
    except ConnectionResetError:
        data = sender.recv(MAX_PACKET, flags)  # see `_receive_to_the_end`
    if len(data) < HEAD.size or len(data) == MAX_PACKET:
        return _receive_other(data, sender, files)
    return data


def receive_plain(sender: socket.socket) -> bytes:
    """As `receive`, but without waiting, and no packet with a descriptor."""
    data: bytes = _receive_to_the_end(sender.recv, MAX_PACKET, socket.MSG_DONTWAIT)
    if not data:
        raise ConnectionResetError
    if len(data) < HEAD.size or len(data) == MAX_PACKET:
        raise MalformedPacket("a packet is too short or too long")
    return data


def _receive_to_the_end(receive_: Callable[..., Any], *arguments: int) -> Any:
    """Receive; of a peer that has closed without reading everything, what it sent before.

    The kernel reports such an end once before the packets that are still in the socket.
    """
    try:
        return receive_(*arguments)
    except ConnectionResetError:
        return receive_(*arguments)


def _receive_other(data: bytes, sender: socket.socket, files: MappedFiles) -> Received:
    """The packet after an announcement; other packets of this size are malformed."""
    while data == ANNOUNCEMENT:
        data, ancillary, state, _ = _receive_to_the_end(
            sender.recvmsg, MAX_PACKET, DESCRIPTOR_SPACE, socket.MSG_CMSG_CLOEXEC
        )
        if ancillary or state & _CUT:
            return _map_packet(data, ancillary, state, files)
    if not data:
        raise ConnectionResetError
    if len(data) < HEAD.size or len(data) == MAX_PACKET:
        raise MalformedPacket("a packet is too short or too long")
    return data


def _map_packet(
    data: bytes, ancillary: list[tuple[int, int, bytes]], state: int, files: MappedFiles
) -> SharedPacket:
    """A packet with its body mapped. Raises `MalformedPacket`; closes what it received."""
    received: array[int] = array("i")
    for level, kind, content in ancillary:
        if (level, kind) == (socket.SOL_SOCKET, socket.SCM_RIGHTS):
            received.frombytes(content[: len(content) - len(content) % 4])
    try:
        if state & _CUT:
            raise MalformedPacket("a packet is longer than allowed")
        if len(received) != 1 or data[1:2] != b"\1" or len(data) < HEAD.size + SIZE.size:
            raise MalformedPacket("a packet and its descriptors do not belong together")
        body = files.view(received.pop(), SIZE.unpack(data[-SIZE.size :])[0])
    finally:
        for descriptor in received:
            os.close(descriptor)
    return SharedPacket(data[:1] + b"\0" + data[2 : -SIZE.size], body)
