"""TCPROS: headers and frames of a connection (http://wiki.ros.org/ROS/TCPROS).

In: bytes of a peer. Out: fields and messages, or `MalformedMessage`. A message has a length of 4
bytes in front, little endian; a header is a message of fields `key=value`, each with a length.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping

from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1.description import MAX_MESSAGE_BYTES
from robocomp_dsl.runtime.middleware.tcp.stream import Part, TcpStream

LENGTH = struct.Struct("<I")
MAX_HEADER_BYTES = 1 << 20


def encode_header(fields: Mapping[str, str]) -> bytes:
    """A header with its length."""
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(LENGTH.pack(len(line)) + line for line in lines)
    return LENGTH.pack(len(body)) + body


def parse_header(data: bytes) -> dict[str, str]:
    """The fields of a header without its length. Raises `MalformedMessage`."""
    fields, at = {}, 0
    while at < len(data):
        if at + 4 > len(data):
            raise MalformedMessage("the header ends within a length", "", at)
        (size,) = LENGTH.unpack_from(data, at)
        line = data[at + 4 : at + 4 + size]
        if len(line) < size:
            what = f"a field of {size} bytes, {len(line)} are left in the header"
            raise MalformedMessage(what, "", at)
        key, equals, value = line.partition(b"=")
        if not equals:
            raise MalformedMessage(f"the header field `{line[:40]!r}` has no `=`", "", at + 4)
        fields[key.decode(errors="replace")] = value.decode(errors="replace")
        at += 4 + size
    return fields


class TcprosStream(TcpStream):
    """One connection of a node."""

    def frame(self, limit: int = MAX_MESSAGE_BYTES) -> Part:
        """The next message. Raises `ConnectionLost`; `MalformedMessage` if it is too long."""
        (size,) = LENGTH.unpack(self.take(4))
        if size > limit:
            raise MalformedMessage(f"a message of {size} bytes, at most {limit} are accepted")
        return self.take_view(size)

    def header(self) -> dict[str, str]:
        """The header of the peer. Raises `ConnectionLost` and `MalformedMessage`."""
        return parse_header(bytes(self.frame(MAX_HEADER_BYTES)))
