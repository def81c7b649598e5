"""The receiving side: served ports, and subscriptions.

In: connections. Out: calls of handlers. The thread of a connection receives and handles, so that a
message wakes one thread only; another thread continues while a handler waits for a remote reply.
"""

from __future__ import annotations

import contextlib
import fcntl
import logging
import socket
import termios
import threading
from collections import deque
from collections.abc import Callable
from struct import Struct
from typing import TYPE_CHECKING, Any, TypeAlias

from robocomp_dsl.runtime.codec.failures import encode_failure
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.errors import InterfaceMismatch, MiddlewareError
from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.codec import Message, message_encoder
from robocomp_dsl.runtime.middleware.local.listener import Listener
from robocomp_dsl.runtime.middleware.local.mapped_files import MalformedPacket, MappedFiles
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool
from robocomp_dsl.runtime.middleware.local.packets import Body, Received
from robocomp_dsl.runtime.middleware.local.ports import Hello, head_of

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort

DEPTH = 256
"""Length of a receive queue without `depth`; the queue is then in the socket and its sender."""
MAX_QUEUED_BYTES = 1 << 28
"""A receive queue drops its oldest messages beyond this size."""
_NUMBER_END = packets.HEAD.size + packets.NUMBER_BYTES
_COUNT = Struct("i")
_ZERO = bytes(_COUNT.size)
log = logging.getLogger("robocomp")

Handler: TypeAlias = Callable[[socket.socket, bytes, Any], None]
"""Handles the message of a connection: its start (head and number), and its body."""


class ReceivingPort:
    """A served port (`kind` is `packets.QUERY`) or a subscription (`packets.PUBLICATION`)."""

    def __init__(self, port: IncomingPort, kind: int, listener: Listener, pool: MemoryPool) -> None:
        self._pool = pool
        self.port = port
        self.kind = kind
        self.depth = port.at.qos.depth or DEPTH
        self.hash = port.interface.hash
        self.name = f"{port.at.component}.{port.at.port}"
        self.start_size = packets.HEAD.size if kind == packets.QUERY else _NUMBER_END
        self.handlers = {
            head_of(packets.QUERY, port.interface, operation): _refuse(operation)
            for operation in port.interface.operations
        }
        self.handlers |= map(self._handler, port.operations.values())
        self.closed = False
        self._connections: set[_Connection] = set()
        self._lock = threading.Lock()
        self._listener = listener
        self._reported = False
        self.address = listener.add(self)

    def accept(self, accepted: socket.socket, hello: Hello) -> None:
        """See `listener.AcceptingPort`."""
        connection = _Connection(self, accepted, hello)
        with self._lock:
            if self.closed:
                accepted.close()
                return
            self._connections.add(connection)
        take = connection.take
        qos = self.port.at.qos
        if self.kind == packets.PUBLICATION and qos.depth and not qos.holds_publisher:
            take = connection.take_latest
        self.port.receive(take, connection.handle)

    def forget(self, connection: _Connection) -> None:
        """A connection has ended."""
        with self._lock:
            self._connections.discard(connection)

    def close(self) -> None:
        """Handle no further messages; running handlers may finish, and reply."""
        with self._lock:
            self.closed = True
            connections = list(self._connections)
        self._listener.remove(self)
        for connection in connections:
            with contextlib.suppress(OSError):
                connection.socket.shutdown(socket.SHUT_RD)

    def malformed(self, error: MalformedPacket, sender: str) -> None:
        """Count a packet that is none of this protocol; its connection is closed."""
        counts = next(iter(self.port.operations.values())).counts
        counts.malformed += 1
        counts.failures += 1
        if not self._reported:
            self._reported = True
            log.warning("%s closed the connection of %s: %s", self.name, sender, error)

    def _handler(self, served: IncomingOperation) -> tuple[bytes, Handler]:
        kind, handler = packets.PUBLICATION, _publication_handler
        if self.kind == packets.QUERY:
            is_command = served.operation.pattern is Pattern.COMMAND
            kind = packets.COMMAND if is_command else packets.QUERY
            handler = _command_handler if is_command else self._query_handler
        return head_of(kind, self.port.interface, served.operation), handler(served)

    def _query_handler(self, served: IncomingOperation) -> Handler:
        operation, counts, handle = served.operation, served.counts, served.handle
        decode = operation.decode_request
        encode = message_encoder(operation.outputs, self._pool, result=True)
        result = head_of(packets.RESULT, self.port.interface, operation)
        failure = head_of(packets.FAILURE, self.port.interface, operation)

        def query(connection: socket.socket, _start: bytes, body: Any) -> None:
            counts.bytes_in += len(body)
            head = result
            reply: Message
            try:
                reply = encode(handle(decode(body)))
            except BaseException as error:
                served.report(error)
                head, reply = failure, self._failure(operation, error)
            try:
                counts.bytes_out += packets.send(connection, head, reply)
            except OSError:  # the caller has ended, or takes no replies
                with contextlib.suppress(OSError):
                    connection.shutdown(socket.SHUT_RDWR)

        return query

    def _failure(self, operation: Operation, error: BaseException) -> Message:
        """The error reply for an exception."""
        data = encode_failure(operation, error)
        if len(data) <= packets.INLINE_BYTES:
            return data
        try:
            return self._pool.message((data,), len(data))
        except MiddlewareError as no_memory:
            return encode_failure(operation, no_memory)


def _command_handler(served: IncomingOperation) -> Handler:
    counts, decode, handle = served.counts, served.operation.decode_request, served.handle

    def command(_connection: socket.socket, _start: bytes, body: Any) -> None:
        counts.bytes_in += len(body)
        try:
            handle(decode(body))
        except BaseException as error:
            served.report(error)

    return command


def _publication_handler(served: IncomingOperation) -> Handler:
    counts, decode, handle = served.counts, served.operation.decode_request, served.handle
    add_number = served.numbers.append

    def publication(_connection: socket.socket, start: bytes, body: Any) -> None:
        counts.bytes_in += len(body)
        add_number(start[4:])
        try:
            handle(decode(body))
        except BaseException as error:
            served.report(error)

    return publication


def _refuse(operation: Operation) -> Handler:
    """The handler of queries of an operation that the component does not serve."""
    data = encode_failure(operation, InterfaceMismatch("there is no such operation"))

    def refuse(connection: socket.socket, start: bytes, _body: Any) -> None:
        with contextlib.suppress(OSError):
            connection.send(bytes((packets.FAILURE,)) + start[1:] + data)

    return refuse


def _limit(queue: deque[Received]) -> None:
    """Drop the oldest packets of a queue that holds too much memory."""
    size = 0
    for number, packet in enumerate(reversed(queue)):
        size += len(packet) if isinstance(packet, bytes) else len(packet.body)
        if size > MAX_QUEUED_BYTES and number:
            for _ in range(len(queue) - number):
                queue.popleft()
            return


class _Connection:
    """A connection from one peer."""

    def __init__(self, port: ReceivingPort, accepted: socket.socket, hello: Hello) -> None:
        self.socket = accepted
        self._port = port
        self._handlers = port.handlers
        self._start_size = port.start_size
        self._sender = hello.name
        self._queue: deque[Received] = deque(maxlen=port.depth)
        self._files = MappedFiles()
        self._ended = False

    def take(self) -> Received:
        """The next packet. Raises `QueueClosed`."""
        return self._receive(0)

    def take_latest(self) -> Received:
        """The next packet of those that the queue keeps, after all that have arrived.

        Raises `QueueClosed` after the last packet of a connection that has ended.
        """
        queue = self._queue
        if self._ended:
            if not queue:
                raise QueueClosed
            return queue.popleft()
        if queue or _COUNT.unpack(fcntl.ioctl(self.socket, termios.FIONREAD, _ZERO))[0]:
            try:
                while True:
                    queue.append(self._receive(socket.MSG_DONTWAIT))
            except BlockingIOError:
                _limit(queue)
            except QueueClosed:
                if not queue:
                    raise
        return queue.popleft() if queue else self._receive(0)

    def _receive(self, flags: int) -> Received:
        try:
            packet = packets.receive(self.socket, self._files, flags)
        except BlockingIOError:
            raise
        except OSError:
            packet = b""
        except MalformedPacket as error:
            self._port.malformed(error, self._sender)
            packet = b""
        if not packet or self._port.closed:
            self._end()
            raise QueueClosed
        return packet

    def handle(self, packet: Received) -> None:
        """Pass a packet to the handler of its operation."""
        if self._port.closed:
            return
        size = self._start_size
        body: Body
        if isinstance(packet, bytes):
            start, body = packet[:size], packet[size:]
        else:
            start, body = packet.start, packet.body
        handler = self._handlers.get(start[:4])
        if handler is None or len(start) != size:
            self._port.malformed(MalformedPacket("no packet of an operation"), self._sender)
            with contextlib.suppress(OSError):
                self.socket.shutdown(socket.SHUT_RDWR)
        else:
            handler(self.socket, start, body)

    def _end(self) -> None:
        """The connection has ended; a handler that still replies gets an error."""
        self._port.forget(self)
        if not self._ended:
            self._ended = True
            self._files.clear()
            self.socket.close()
