"""The calling side: one connection for each thread that calls, which reads its replies itself.

In: the record of a server. Out: functions that send a request and return the reply. No other thread
is involved. A connection on which a call failed is not used again, so a late reply is never taken
for another one.
"""

from __future__ import annotations

import contextlib
import socket
import threading
import weakref
from collections.abc import Callable
from typing import Any, NoReturn

from robocomp_dsl.runtime.codec.failures import decode_failure
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import InterfaceMismatch, MalformedMessage, Timeout
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.brief_poll import BriefPoll
from robocomp_dsl.runtime.middleware.local.codec import Message, message_encoder
from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket, MappedFiles
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool
from robocomp_dsl.runtime.middleware.local.packets import Body, Received
from robocomp_dsl.runtime.middleware.local.ports import head_of, hello_packet, parse_address
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.presence.port_record import PortRecord


class Connection:
    """The connection of one thread to a server."""

    __slots__ = ("__weakref__", "files", "socket", "wait_briefly")

    def __init__(self, opened: socket.socket) -> None:
        self.socket = opened
        self.files = MappedFiles()
        self.wait_briefly = BriefPoll(opened).wait

    def __del__(self) -> None:
        self.socket.close()


class LocalClient:
    """The connections of a required port to one server."""

    def __init__(self, at: Endpoint, server: PortRecord, timeout: float, pool: MemoryPool) -> None:
        self._at = at
        self._pool = pool
        self._server = server
        self._timeout = timeout
        self._of_thread = threading.local()
        self._connections: weakref.WeakSet[Connection] = weakref.WeakSet()
        self._lock = threading.Lock()
        self._cancelled = False

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `transport.ServiceClient`."""
        encode = message_encoder(operation.inputs, self._pool)
        if operation.pattern is Pattern.COMMAND:
            return BoundOperation(encode, self._command(operation, counts))
        return BoundOperation(encode, self._query(operation, counts))

    def _command(self, operation: Operation, counts: OperationCounts) -> Callable[[Message], None]:
        head = head_of(packets.COMMAND, self._at.interface, operation)
        of_thread = self._of_thread

        def command(message: Message) -> None:
            connection = getattr(of_thread, "connection", None) or self._open(operation)
            try:
                counts.bytes_out += packets.send(connection.socket, head, message)
            except BaseException as error:
                self._fail(connection, operation, error)

        return command

    def _query(self, operation: Operation, counts: OperationCounts) -> Callable[[Message], Any]:
        head = head_of(packets.QUERY, self._at.interface, operation)
        result = head_of(packets.RESULT, self._at.interface, operation)
        of_thread = self._of_thread
        receive = packets.receive
        decode: Callable[[Any], Any] = operation.decode_reply

        def query(message: Message) -> Any:
            body: Body
            connection = getattr(of_thread, "connection", None) or self._open(operation)
            try:
                if isinstance(message, bytes):
                    connection.socket.send(head + message)
                    counts.bytes_out += len(message)
                else:
                    counts.bytes_out += packets.send(connection.socket, head, message)
                connection.wait_briefly()
                reply = receive(connection.socket, connection.files)
                if isinstance(reply, bytes):
                    start, body = reply[:4], reply[4:]
                else:
                    start, body = reply.start, reply.body
            except BaseException as error:
                self._fail(connection, operation, error)
            counts.bytes_in += len(body)
            if start == result:
                return decode(body)
            if start[0] != packets.FAILURE:
                self._fail(connection, operation, MalformedPacket("an unexpected reply"))
            raise decode_failure(operation, self._server.name, bytes(body), self._timeout)

        return query

    def _open(self, operation: Operation) -> Connection:
        """The connection of this thread, which the server has accepted."""
        path, port = parse_address(self._server.address)
        with self._lock:
            if self._cancelled:
                self._fail(None, operation, ConnectionResetError())
            connection = Connection(packets.new_socket(self._timeout))
            self._connections.add(connection)
        try:
            connection.socket.connect(path)
            connection.socket.send(hello_packet(self._at, port, packets.QUERY))
            _check_answer(packets.receive(connection.socket, connection.files))
        except BaseException as error:
            self._fail(connection, operation, error)
        self._of_thread.connection = connection
        return connection

    def _fail(
        self, connection: Connection | None, operation: Operation, error: BaseException
    ) -> NoReturn:
        """Close the connection and raise what `error` means for the caller."""
        self._of_thread.connection = None
        if connection is not None:
            connection.socket.close()
        what = f"{self._server.name}.{operation.name}"
        if isinstance(error, BlockingIOError):
            raise Timeout(f"{what} did not reply within {self._timeout:g} s") from None
        if isinstance(error, OSError):
            reason = "the component that served it exited"
            if self._cancelled:
                reason = f"{self._at.component}, which called it, is stopping"
            raise ServerLost(f"{what}: {reason}") from None
        if isinstance(error, MalformedPacket):
            raise MalformedMessage(f"{what}: {error}") from None
        raise error

    def set_timeout(self, seconds: float) -> None:
        """See `transport.ServiceClient`."""
        self._timeout = seconds
        for connection in list(self._connections):
            with contextlib.suppress(OSError):  # closed by its thread
                packets.limit_waits(connection.socket, seconds)

    def cancel(self) -> None:
        """See `transport.ServiceClient`."""
        with self._lock:
            self._cancelled = True
            connections = list(self._connections)
        for connection in connections:
            with contextlib.suppress(OSError):  # not connected, or closed by its thread
                connection.socket.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """See `transport.ServiceClient`."""
        self.cancel()


def _check_answer(answer: Received) -> None:
    """The answer to the first packet. Raises `InterfaceMismatch` and `MalformedPacket`."""
    if isinstance(answer, bytes) and answer[0] == packets.REFUSED:
        raise InterfaceMismatch(answer[packets.HEAD.size :].decode(errors="replace"))
    if not isinstance(answer, bytes) or answer[0] != packets.READY:
        raise MalformedPacket("an unexpected answer to the first packet")
