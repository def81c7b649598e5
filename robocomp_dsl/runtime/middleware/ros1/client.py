"""Calls the services of one port.

Each call has a persistent connection for itself while it waits for its reply; connections are kept
and used again. Commands are topics: a component gets them over one connection, in order.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import InterfaceMismatch, MalformedMessage, NoServer, Timeout
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
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.presence.port_record import PortRecord

DISCOVERY_TIMEOUT_S = 1.0
"""A command waits this long for the first subscriber of its topic."""
POLL_S = 0.005


class Ros1Client:
    """Calls the server of one record."""

    def __init__(self, node: RosNode, at: Endpoint, server: PortRecord, timeout: float) -> None:
        """Raises `MiddlewareError` for an invalid address."""
        self._node = node
        self._at = at
        self._server = server
        self._is_external = not server.hash
        self._address = parse_address(server.address, at.port)
        self._timeout = timeout
        self._lock = threading.Lock()
        self._command_lock = threading.Lock()
        self._idle: dict[str, list[TcprosStream]] = {}
        """By service; a component needs one kind of connection."""
        self._opened: set[TcprosStream] = set()
        self._command_stream: TcprosStream | None = None
        self._port_header = port_header(node.name, self._address.name, at.interface)
        self._publications: dict[str, Publication] = {}
        self._cancelled = False

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.ServiceClient`."""
        if is_topic(operation, published=False):
            return self._command(operation, counts)
        return self._query(operation, counts)

    def _query(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        service = service_of(self._address.name, self._at.interface, operation)
        timeout, what = self._timeout, f"{self._server.name}.{operation.name}"
        header = self._port_header
        prefix = INDEX.pack(self._at.interface.operations.index(operation))
        if self._is_external:
            header, prefix = _service_header(self._node.name, service), b""
        idle = self._idle.setdefault(header.get("service", ""), [])
        is_ros, decode = service.is_ros, service.decode_reply

        def query(data: bytes) -> Any:
            deadline = time.monotonic() + timeout
            stream = self._take_stream(idle, header, what, deadline, timeout)
            try:
                stream.send(LENGTH.pack(len(prefix) + len(data)) + prefix, data)
                counts.bytes_out += len(data)
                is_ok, reply = read_reply(stream)
            except ConnectionLost as error:
                self._drop(stream)
                raise self._failure(error, what, timeout) from None
            except MalformedMessage as error:
                self._drop(stream)
                raise _malformed(what, error) from None
            except BaseException:
                self._drop(stream)
                raise
            counts.bytes_in += len(reply)
            self._keep(idle, stream)
            if not is_ok:
                raise decode_failure(operation, what, bytes(reply), timeout, is_ros=is_ros)
            try:
                return decode(reply)
            except MalformedMessage as error:
                raise _malformed(what, error) from None

        return BoundOperation(service.encode_request, query)

    def _take_stream(
        self,
        idle: list[TcprosStream],
        header: dict[str, str],
        what: str,
        deadline: float,
        timeout: float,
    ) -> TcprosStream:
        """An idle connection that is still open, or a new one."""
        while True:
            with self._lock:
                if self._cancelled:
                    raise ServerLost(self._server.name)
                stream = idle.pop() if idle else None
            if stream is None:
                stream = self._open(header, what, deadline, timeout)
            elif stream.is_closed():
                self._drop(stream)
                continue
            stream.deadline = deadline
            return stream

    def _open(
        self, header: dict[str, str], what: str, deadline: float, timeout: float
    ) -> TcprosStream:
        """A new connection whose peer has accepted `header`."""
        host, number = self._address.host, self._address.number
        if not number:
            host, number = self._look_up(header["service"], timeout)
        left = max(0.001, deadline - time.monotonic())
        try:
            stream = TcprosStream.connect((host, number), left)
        except ConnectionLost as error:
            if self._is_external and not error.timed_out:
                raise NoServer(
                    f"{self._at.port}: the ROS service {header['service']} at {host}:{number}"
                    f" cannot be reached: {error}; start its node again"
                ) from None
            raise self._failure(error, what, timeout) from None
        with self._lock:
            self._opened.add(stream)
        try:
            exchange_headers(stream, header, max(0.001, deadline - time.monotonic()))
        except Refused as error:
            self._drop(stream)
            raise InterfaceMismatch(f"{self._at.port}: {what}: {error}") from None
        except ConnectionLost as error:
            self._drop(stream)
            raise self._failure(error, what, timeout) from None
        if self._cancelled:
            self._drop(stream)
            raise ServerLost(self._server.name)
        return stream

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
        header, index = self._port_header, self._at.interface.operations.index(operation)

        def command(data: bytes) -> None:
            deadline = time.monotonic() + timeout
            with self._command_lock:
                stream, self._command_stream = self._command_stream, None
                if stream is not None and stream.is_closed():
                    self._drop(stream)
                    raise ServerLost(self._server.name)
                if self._cancelled:
                    raise ServerLost(self._server.name)
                if stream is None:
                    stream = self._open(header, what, deadline, timeout)
                stream.deadline = deadline
                try:
                    stream.send(*frame(index, publication.counter(), data).parts)
                except ConnectionLost as error:
                    self._drop(stream)
                    raise self._failure(error, what, timeout) from None
                self._command_stream = stream
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

    def _failure(self, error: ConnectionLost, what: str, timeout: float) -> Exception:
        if self._cancelled:
            return ServerLost(self._server.name)
        if error.timed_out:
            return Timeout(f"{what} did not reply within {timeout:g} s")
        return ServerLost(f"{self._server.name}: the connection was lost ({error})")

    def _keep(self, idle: list[TcprosStream], stream: TcprosStream) -> None:
        with self._lock:
            if not self._cancelled:
                idle.append(stream)
                return
        self._drop(stream)

    def _drop(self, stream: TcprosStream) -> None:
        with self._lock:
            self._opened.discard(stream)
        stream.close()

    def set_timeout(self, seconds: float) -> None:
        """See `transport.ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `transport.ServiceClient`."""
        with self._lock:
            self._cancelled = True
            opened, self._opened = self._opened, set()
            for idle in self._idle.values():
                idle.clear()
        for stream in opened:
            stream.close()

    def close(self) -> None:
        """See `transport.ServiceClient`."""
        self.cancel()
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


def _malformed(what: str, error: MalformedMessage) -> MalformedMessage:
    return MalformedMessage(f"the reply of {what}: {error.reason}", error.path, error.offset)
