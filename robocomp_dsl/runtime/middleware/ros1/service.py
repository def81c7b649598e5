"""A service that the node offers: clients connect, each has a thread.

In: connections with the header field `service`. Out: replies; an error reply has the byte 0 and a
text. A client that is not `persistent` makes one call.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1 import tcpros
from robocomp_dsl.runtime.middleware.ros1.failures import encode_failure
from robocomp_dsl.runtime.middleware.ros1.handshake import refusal, refuse
from robocomp_dsl.runtime.middleware.ros1.incoming_links import IncomingLinks
from robocomp_dsl.runtime.middleware.ros1.operations import Ros1Service, service_of
from robocomp_dsl.runtime.middleware.ros1.tcpros import LENGTH, TcprosStream

_OK, _FAILED = b"\x01", b"\x00"


class ServiceServer:
    """One service; `name` is that of its port."""

    def __init__(self, node: str, name: str, port: IncomingPort, served: IncomingOperation) -> None:
        self.service: Ros1Service = service_of(name, port.interface, served.operation)
        self.requests = 0
        self._node = node
        self._served = served
        self._links = IncomingLinks()

    def accept(self, stream: TcprosStream, header: dict[str, str]) -> str:
        """Serve a client until its connection ends; returns why it was refused, if it was."""
        service = self.service
        type_ = service.type
        if reason := refusal(service.name, type_, header, "calls"):
            refuse(stream, reason)
            return reason
        reply = {
            "callerid": self._node,
            "md5sum": type_.md5,
            "request_type": f"{type_.name}Request",
            "response_type": f"{type_.name}Response",
            "type": type_.name,
        }
        stream.send(tcpros.encode_header(reply))
        if header.get("probe") == "1":
            return ""
        with self._links.serving(stream, header.get("callerid", "")):
            self._serve(stream, is_persistent=header.get("persistent", "") in {"1", "true"})
        return ""

    def _serve(self, stream: TcprosStream, *, is_persistent: bool) -> None:
        while True:
            try:
                data = stream.frame()
            except MalformedMessage as error:
                self._served.report(error)
                stream.send(*self._failure(error))
                return
            buffers = self.reply(data)
            self._links.check_open()  # the caller learns that the server ended
            stream.send(*buffers)
            if not is_persistent:
                return

    def reply(self, data: Any, _peer: str = "") -> tuple[bytes, bytes]:
        """The reply to a request. Never raises."""
        service, served = self.service, self._served
        served.counts.bytes_in += len(data)
        self.requests += 1
        try:
            reply = service.encode_reply(served.handle(service.decode_request(data)))
        except BaseException as error:
            served.report(error)
            return self._failure(error)
        served.counts.bytes_out += len(reply)
        return _OK + LENGTH.pack(len(reply)), reply

    def _failure(self, error: BaseException) -> tuple[bytes, bytes]:
        text = encode_failure(self._served.operation, error, is_ros=self.service.is_ros)
        return _FAILED + LENGTH.pack(len(text)), text

    def close(self) -> None:
        """End all connections; running handlers may finish."""
        self._links.close()


def read_reply(stream: TcprosStream) -> tuple[bool, bytes | memoryview]:
    """Whether a call succeeded, and the reply or the text. Raises as `TcprosStream.frame`."""
    is_ok = bool(stream.take(1)[0])
    return is_ok, stream.frame()
