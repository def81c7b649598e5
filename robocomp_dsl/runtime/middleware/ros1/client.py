"""Calls the services of one port.

Connections are persistent. Commands are topics: a component gets them in order.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import InterfaceMismatch, MalformedMessage, NoServer
from robocomp_dsl.runtime.middleware.ros1.addresses import parse_address
from robocomp_dsl.runtime.middleware.ros1.failures import decode_failure
from robocomp_dsl.runtime.middleware.ros1.handshake import Refused, exchange_headers
from robocomp_dsl.runtime.middleware.ros1.node import RosNode
from robocomp_dsl.runtime.middleware.ros1.operations import Ros1Service, service_of, topic_of
from robocomp_dsl.runtime.middleware.ros1.port_receiver import INDEX, frame, port_header
from robocomp_dsl.runtime.middleware.ros1.publication import Publication
from robocomp_dsl.runtime.middleware.ros1.service import read_reply
from robocomp_dsl.runtime.middleware.ros1.tcpros import LENGTH, TcprosStream
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi, RosApiError
from robocomp_dsl.runtime.middleware.ros_common.interface_types import is_topic
from robocomp_dsl.runtime.middleware.tcp.client import TcpClient, TimedCall
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost, Part
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.presence.port_record import PortRecord

DISCOVERY_TIMEOUT_S = 1.0
"""A command waits this long for the first subscriber of its topic."""
POLL_S = 0.005


class Ros1Client(TcpClient[TcprosStream]):
    """Calls the server of one record."""

    def __init__(self, node: RosNode, at: Endpoint, server: PortRecord, timeout: float) -> None:
        """Raises `MiddlewareError` for an invalid address."""
        super().__init__(server, timeout)
        self._node = node
        self._at = at
        self._address = parse_address(server.address, at.port)
        port = port_header(node.name, self._address.name, at.interface)
        self._headers: dict[str, dict[str, str]] = {"": port}
        """By service; a component needs one kind of connection."""
        self._publications: dict[str, Publication] = {}

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.ServiceClient`."""
        if is_topic(operation, published=False):
            return self._command(operation, counts)
        return self._query(operation, counts)

    def _query(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        service = service_of(self._address.name, self._at.interface, operation)
        timeout, what = self._timeout, f"{self._server.name}.{operation.name}"
        prefix, key = INDEX.pack(self._at.interface.operations.index(operation)), ""
        if self._is_external:
            prefix, key = b"", service.name
            self._headers[key] = _service_header(self._node.name, service)
        is_ros, decode = service.is_ros, service.decode_reply

        def query(data: bytes) -> Any:
            call = TimedCall(what, timeout)

            def exchange(stream: TcprosStream) -> tuple[bool, Part]:
                stream.send(LENGTH.pack(len(prefix) + len(data)) + prefix, data)
                counts.bytes_out += len(data)
                return read_reply(stream)

            is_ok, reply = self._exchange(call, exchange, key)
            counts.bytes_in += len(reply)
            if not is_ok:
                raise decode_failure(operation, what, bytes(reply), timeout, is_ros=is_ros)
            try:
                return decode(reply)
            except MalformedMessage as error:
                raise call.malformed(error) from None

        return BoundOperation(service.encode_request, query)

    def _connect(self, call: TimedCall, service: str) -> TcprosStream:
        host, number = self._address.host, self._address.number
        if not number:
            host, number = self._look_up(service, call.timeout)
        try:
            return TcprosStream.connect((host, number), call.remaining)
        except ConnectionLost as error:
            if self._is_external and not error.timed_out:
                raise NoServer(
                    f"{self._at.port}: the ROS service {service} at {host}:{number}"
                    f" cannot be reached: {error}; start its node again"
                ) from None
            raise

    def _set_up(self, stream: TcprosStream, call: TimedCall, service: str) -> None:
        try:
            exchange_headers(stream, self._headers[service], call.remaining)
        except Refused as error:
            raise InterfaceMismatch(f"{self._at.port}: {call.what}: {error}") from None

    def _look_up(self, service: str, timeout: float) -> tuple[str, int]:
        """Host and TCP port of a service, as the master knows it. Raises `NoServer`."""
        api = RosApi(self._node.master, timeout)
        try:
            uri = str(api.call("lookupService", self._node.name, service))
            parts = urlsplit(uri)
            found = parts.hostname or "", parts.port or 0
        except RosApiError as error:
            hint = "start the master with `roscore`" if error.is_unreachable else "start its node"
            raise NoServer(
                f"{self._at.port}: no ROS service {service} at the master {self._node.master}:"
                f" {error}; {hint}"
            ) from None
        except ValueError:
            raise NoServer(f"{self._at.port}: {service} has the address `{uri}`") from None
        finally:
            api.close()
        return found

    def _command(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        topic = topic_of(self._address.name, self._at.interface, operation)
        timeout, what = self._timeout, f"{self._server.name}.{operation.name}"
        publication = Publication(self._node.name, topic, self._at.qos)
        if self._is_external:
            self._node.add_publication(publication)
            self._publications[operation.name] = publication
            return BoundOperation(topic.encode, self._publish(publication, counts))
        index = self._at.interface.operations.index(operation)

        def command(data: bytes) -> None:
            call = TimedCall(what, timeout)

            def send(stream: TcprosStream) -> None:
                stream.send(*frame(index, publication.counter(), data).parts)

            self._send_in_order(call, send)
            counts.bytes_out += len(data)

        return BoundOperation(topic.encode, command)

    def _publish(
        self, publication: Publication, counts: OperationCounts
    ) -> Callable[[bytes], None]:
        """A function that sends a command to the subscribers of a topic of ROS."""

        def command(data: bytes) -> None:
            limit = time.monotonic() + min(DISCOVERY_TIMEOUT_S, self._timeout)
            while not publication.links and time.monotonic() < limit and not self._cancelled:
                time.sleep(POLL_S)
            if self._cancelled:
                raise ServerLost(self._server.name)
            if not publication.links:
                raise NoServer(
                    f"{self._at.port}: no ROS node subscribes to {publication.topic.name}"
                    f" ({publication.topic.type.name}) at the master {self._node.master}"
                )
            publication.publish(data, counts)
            counts.bytes_out += len(data)

        return command

    def close(self) -> None:
        """See `transport.ServiceClient`."""
        super().close()
        for publication in self._publications.values():
            self._node.remove_publication(publication)


def _service_header(node: str, service: Ros1Service) -> dict[str, str]:
    return {
        "callerid": node,
        "md5sum": service.type.md5,
        "persistent": "1",
        "service": service.name,
        "type": service.type.name,
    }
