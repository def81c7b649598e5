"""The connection of a port to one reader."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import CONNECT_S, OutgoingLink
from robocomp_dsl.runtime.middleware.tcp.stream import TcpStream
from robocomp_dsl.runtime.middleware.yarp import outgoing
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.outgoing import Resolve


class OutputLink(OutgoingLink):
    """One connected reader. Only `fast_tcp` has neither acknowledgements nor text."""

    def __init__(
        self,
        address: PortAddress,
        sender: str,
        resolve: Resolve,
        qos: Qos,
        on_end: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(sender, address.name, qos, on_end)
        self.address = address
        self.where = str(address)
        self.sends_at_once = address.carrier == "fast_tcp"
        self._resolve = resolve

    def _open(self) -> TcpStream:
        return outgoing.open_connection(self._resolve(self.address), self._sender, CONNECT_S)

    def _sent(self, stream: Any) -> None:
        outgoing.read_ack(stream, self.address.carrier)

    def _finish(self, stream: TcpStream) -> None:
        stream.send(outgoing.end_bytes(self.address.carrier))
