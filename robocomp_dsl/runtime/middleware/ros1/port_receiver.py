"""A served or subscribed port, as other components reach it: one connection for all operations.

In: connections with the header fields `port` and the hash of the interface. Out: arguments in the
queue of the port, and replies. A message is its length, the index of the operation in the interface
(2 bytes), and the body of the ROS message; a reply is that of a ROS service. So the order of the
messages of different operations stays, which topics of ROS do not promise.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, TypeAlias

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1 import tcpros
from robocomp_dsl.runtime.middleware.ros1.incoming_links import IncomingLink, IncomingLinks
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import TcpMessage
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost

INDEX = struct.Struct("<H")
PORT_KEY = "port"
Handler: TypeAlias = "Callable[[Any, str], tuple[bytes, bytes] | None]"
"""From the body of a message and the name of its sender to the reply, if there is one."""


def port_header(node: str, name: str, interface: Interface) -> dict[str, str]:
    """What both sides of a connection of components tell."""
    return {
        "callerid": node,
        "md5sum": interface.hash.hex(),
        PORT_KEY: name,
        "type": interface.name,
    }


def frame(operation: int, counter: bytes, data: bytes) -> TcpMessage:
    """A message of an operation; `counter` is that of its header, or empty."""
    prefix = INDEX.pack(operation) + counter
    return TcpMessage(tcpros.LENGTH.pack(len(prefix) + len(data)) + prefix, data)


class PortReceiver:
    """`handlers` by the index of the operation."""

    def __init__(
        self, node: str, name: str, port: IncomingPort, handlers: dict[int, Handler]
    ) -> None:
        self.name = name
        self.interface = port.interface
        self._header = port_header(node, name, port.interface)
        self._handlers = handlers
        self._port = port
        self.connections = IncomingLinks()
        """The components that are connected."""

    def refusal(self, header: dict[str, str]) -> str:
        """Why a component cannot be connected; empty if it can."""
        if header.get("md5sum") == self._header["md5sum"]:
            return ""
        return (
            f"{header.get('callerid', 'a component')} was generated from another version of"
            f" {self.interface.name} than {self._port.at.name}; generate both again"
        )

    def accept(self, stream: TcprosStream, header: dict[str, str]) -> None:
        """Receive until the connection ends, which raises `ConnectionLost`."""
        stream.send(tcpros.encode_header(self._header))
        peer = header.get("callerid", "a component")
        with self.connections.serving(stream, peer) as link:
            self._receive(link)

    def _receive(self, link: IncomingLink) -> None:
        stream, handlers = link.stream, self._handlers
        while True:
            try:
                data = stream.frame()
                (index,) = INDEX.unpack_from(data)
                handler = handlers[index]
            except (MalformedMessage, struct.error, KeyError) as error:
                self._report(link.peer, error)
                raise ConnectionLost(str(error)) from None
            link.messages_in += 1
            reply = handler(data[INDEX.size :], link.peer)
            if reply is not None:
                self.connections.check_open()
                stream.send(*reply)

    def _report(self, peer: str, error: Exception) -> None:
        reason = error.reason if isinstance(error, MalformedMessage) else "no such operation"
        for served in self._port.operations.values():
            served.report(MalformedMessage(f"{reason} (from {peer})"))
            return

    def close(self) -> None:
        """End all connections; running handlers may finish."""
        self.connections.close()
