"""Addresses of ports, and the first packets of connections.

The address of a port is `PATH#NUMBER`: the socket of its component, and the port on it.
"""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket


@dataclass(frozen=True, slots=True)
class Hello:
    """What a peer says of itself; `kind` is QUERY of a client, PUBLICATION of a publisher."""

    hash: bytes
    port: int
    kind: int
    name: str


def make_address(path: str, port: int) -> str:
    """The address of a port."""
    return f"{path}#{port}"


def parse_address(address: str) -> tuple[str, int]:
    """Path and port of an address; -1 for the port of an invalid one."""
    path, _, port = address.rpartition("#")
    return path, int(port) if port.isdecimal() else -1


def head_of(kind: int, interface: Interface, operation: Operation) -> bytes:
    """The head of packets of this operation: its index is that among the sorted names."""
    names = sorted(o.name for o in interface.operations)
    return packets.HEAD.pack(kind, 0, names.index(operation.name))


def hello_packet(at: Endpoint, port: int, kind: int) -> bytes:
    """The first packet of a connection from `at`."""
    name = f"{at.component}.{at.port}".encode()[: packets.MAX_NAME_BYTES]
    fixed = packets.HELLO_FORMAT.pack(packets.MAGIC, at.interface.hash, max(port, 0), kind)
    return packets.HEAD.pack(packets.HELLO, 0, 0) + fixed + name


def parse_hello(packet: packets.Received) -> Hello:
    """The content of a first packet. Raises `MalformedPacket`."""
    start, form = packets.HEAD.size, packets.HELLO_FORMAT
    if not isinstance(packet, bytes) or len(packet) < start + form.size:
        raise MalformedPacket("a connection without a greeting")
    magic, digest, port, kind = form.unpack_from(packet, start)
    if packet[0] != packets.HELLO or magic != packets.MAGIC:
        raise MalformedPacket("a connection of another protocol")
    name = packet[start + form.size :][: packets.MAX_NAME_BYTES]
    return Hello(digest, port, kind, name.decode(errors="replace"))
