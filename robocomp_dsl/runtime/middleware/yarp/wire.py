"""Bytes of YARP's tcp and fast_tcp carriers: numbers, set-up, and frames of messages.

In: payloads. Out: bytes, and back. The layout is that of YARP 3.5 (`os/impl/Protocol.cpp`).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.yarp.description import MAX_MESSAGE_BYTES
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream

_NUMBER = struct.Struct("<2si2s")
_INT = struct.Struct("<i")
_COUNTS = struct.Struct("<BB8s")
_SPECIFIER_BASE = 7777
_ACKS = 128
_TCP = 3
_TILDE = ord("~")
MAX_NAME = 1000
"""Bytes of the name of a sender."""


def number(value: int) -> bytes:
    """A "YARP number"."""
    return _NUMBER.pack(b"YA", value, b"RP")


INDEX = number(10)
ACK = number(0)


def read_number(data: bytes) -> int | None:
    """The value of a "YARP number"; None if it is none."""
    begin, value, end = _NUMBER.unpack(data)
    return value if (begin, end) == (b"YA", b"RP") else None


def carrier_of(data: bytes) -> str:
    """The carrier of a connection that starts with these 8 bytes; empty if unknown."""
    specifier = (read_number(data) or 0) - _SPECIFIER_BASE
    if specifier < 0 or specifier & ~_ACKS != _TCP:
        return ""
    return "tcp" if specifier & _ACKS else "fast_tcp"


def set_up(carrier: str, sender: str) -> bytes:
    """What a client sends first."""
    specifier = _TCP + (_ACKS if carrier == "tcp" else 0)
    name = sender.encode(errors="replace")[: MAX_NAME - 1] + b"\0"
    return number(_SPECIFIER_BASE + specifier) + _INT.pack(len(name)) + name


def read_sender(stream: YarpStream) -> str:
    """The name of a client, without the modifiers of its carrier."""
    (size,) = _INT.unpack(stream.take(4))
    data = stream.take(min(max(size, 1), MAX_NAME))
    words = data.split(b"\0")[0].decode(errors="replace").split()
    return words[0] if words else ""


def frame(payload: bytes, command: str = "D", envelope: str = "") -> bytes:
    """A message. `command`: `D` data, `d` data with a reply, `a` admin; `q` has no payload."""
    return frame_head(len(payload), command, envelope) + payload


def frame_head(size: int, command: str = "D", envelope: str = "") -> bytes:
    """The part of a message before its payload of `size` bytes."""
    text = command if command == "q" else f"{command} {envelope}" if envelope else ""
    if text:
        data = text.encode() + b"\0"
        header = _INT.pack(len(data)) + b"~\0\0\1" + data
    else:
        header = _INT.pack(0) + b"~" + command.encode() + b"\0\1"
    sizes = [len(header), size] if size else [len(header)]
    lengths = b"".join(map(_INT.pack, sizes))
    counts = _COUNTS.pack(len(sizes), 1, b"\xff" * 8)
    return b"".join((INDEX, counts, lengths, _INT.pack(0), header))


@dataclass(frozen=True, slots=True)
class YarpMessage:
    """A received message: `command` as in `frame`, or another command of the port."""

    command: str
    envelope: str
    payload: bytes | memoryview
    size: int


def read_message(stream: YarpStream) -> YarpMessage:
    """The next message. Raises `MalformedMessage` if the bytes are no frame, `ConnectionLost`."""
    head = read_number(stream.take(8))
    if head != 10:
        raise MalformedMessage("the frame does not start with an index")
    blocks, replies, _ = _COUNTS.unpack(stream.take(_COUNTS.size))
    sizes = struct.unpack(f"<{blocks}i", stream.take(4 * blocks))
    stream.take(4 * replies)
    size = sum(sizes)
    if min(sizes, default=0) < 0 or size > MAX_MESSAGE_BYTES:
        raise MalformedMessage(f"the frame announces blocks of {size} bytes in total")
    return _split(memoryview(stream.take_view(size)), size)


def _split(data: memoryview, size: int) -> YarpMessage:
    """The port header and the payload."""
    if size < 8 or data[4] != _TILDE:
        raise MalformedMessage("the frame has no header of a port")
    (length,) = _INT.unpack_from(data)
    if not 0 <= length <= min(size - 8, MAX_NAME):
        raise MalformedMessage(f"the header of the port claims a text of {length} bytes")
    if not length:
        return YarpMessage(chr(data[5]), "", data[8:], size)
    text = bytes(data[8 : 8 + length]).split(b"\0")[0].decode(errors="replace")
    command, _, envelope = text.partition(" ")
    return YarpMessage(command, envelope, data[8 + length :], size)
