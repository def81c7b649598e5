"""The transport: served ports, clients, publishers and subscriptions.

Every calling thread has a connection of its own, whose thread in the server runs the handler.
Commands and publications go through a queue of the port.
"""

from __future__ import annotations

import contextlib
import socket
import threading
from collections import deque
from collections.abc import Callable
from typing import Any

from robocomp_dsl_pipe.frames import Listener, connect, receive, send, shut_down

from robocomp_dsl.runtime.codec.failures import decode_failure, encode_failure
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.errors import Timeout
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost, TransportContext
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT

SEND_DEPTH = 256
"""Messages that wait for a subscriber that does not receive; then the oldest are dropped."""
FLUSH_S = 0.5
"""A subscriber that does not receive holds the end of a publisher so long."""
_RESULT, _FAILURE = b"r", b"f"


def open_transport(_context: TransportContext) -> PipeTransport:
    """The transport of one component."""
    return PipeTransport()


class PipeTransport:
    """All connections of one component."""

    def serve(self, port: IncomingPort) -> PipePort:
        """See `Transport`."""
        return PipePort(port, prefix=0)

    def subscribe(self, port: IncomingPort) -> PipePort:
        """See `Transport`."""
        return PipePort(port, prefix=SEQUENCE_FORMAT.size)

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> PipeClient:
        """See `Transport`."""
        return PipeClient(server, timeout)

    def advertise(self, at: Endpoint) -> PipePublisher:
        """See `Transport`."""
        return PipePublisher(at)

    def close(self) -> None:
        """See `Transport`."""


class PipePort:
    """A served or subscribed port; `prefix` is the size of the number in front of a payload."""

    def __init__(self, port: IncomingPort, prefix: int) -> None:
        self._operations = port.operations
        self._prefix = prefix
        self._queue = MessageQueue(port)
        self._listener = Listener(port.at.name, self._receive)
        self.address = self._listener.address

    def _receive(self, connection: socket.socket) -> None:
        while True:
            name, data = receive(connection)
            served = self._operations.get(name)
            if served is None:
                send(connection, _FAILURE, b"RCIthere is no such operation")
            elif served.operation.pattern is Pattern.QUERY or not self._is_one_way(served):
                send(connection, *self._reply(served, data))
            else:
                self._enqueue(served, data)

    def _is_one_way(self, served: Any) -> bool:
        return bool(self._prefix) or served.operation.pattern is Pattern.COMMAND

    def _reply(self, served: Any, data: bytes) -> tuple[bytes, bytes]:
        operation: Operation = served.operation
        try:
            served.counts.bytes_in += len(data)
            result = operation.encode_reply(served.handle(operation.decode_request(data)))
            served.counts.bytes_out += len(result)
        except BaseException as error:
            served.report(error)
            return _FAILURE, encode_failure(operation, error)
        return _RESULT, result

    def _enqueue(self, served: Any, data: bytes) -> None:
        try:
            if self._prefix:
                served.numbers.append(data[: self._prefix])
                data = data[self._prefix :]
            served.counts.bytes_in += len(data)
            self._queue.put(served, served.handle, served.operation.decode_request(data))
        except BaseException as error:
            served.report(error)

    def close(self) -> None:
        """See `PortServer` and `Subscription`."""
        self._listener.close()
        self._queue.close()


class PipeClient:
    """Connections to one server: one for each thread that calls at the same time."""

    def __init__(self, server: PortRecord, timeout: float) -> None:
        self._server = server
        self._timeout = timeout
        self._free: deque[socket.socket] = deque()
        self._used: set[socket.socket] = set()
        self._commands: socket.socket | None = None
        self._lock = threading.Lock()
        self._canceled = False

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `ServiceClient`."""
        if operation.pattern is Pattern.COMMAND:
            return BoundOperation(operation.encode_request, self._command(operation, counts))
        return BoundOperation(operation.encode_request, self._query(operation, counts))

    def _query(self, operation: Operation, counts: OperationCounts) -> Callable[[bytes], Any]:
        name, server = operation.name.encode(), self._server.name

        def query(data: bytes) -> Any:
            timeout = self._timeout
            counts.bytes_out += len(data)
            try:
                connection = self._take()
                connection.settimeout(timeout)
                send(connection, name, data)
                kind, reply = receive(connection)
            except TimeoutError:
                # A late reply must not be taken for that of the next call.
                self._drop(connection)
                raise decode_failure(operation, server, b"Timeout", timeout) from None
            except (OSError, EOFError):
                raise ServerLost(server) from None
            self._give_back(connection)
            counts.bytes_in += len(reply)
            if kind.encode() == _FAILURE:
                raise decode_failure(operation, server, reply, timeout)
            return operation.decode_reply(reply)

        return query

    def _command(self, operation: Operation, counts: OperationCounts) -> Callable[[bytes], None]:
        name, server = operation.name.encode(), self._server.name

        def command(data: bytes) -> None:
            try:
                with self._lock:
                    send(self._command_connection(), name, data)
            except TimeoutError:
                self.cancel()  # half of a message may have been sent
                raise Timeout(f"{server} does not receive {operation.name}") from None
            except (OSError, EOFError):
                raise ServerLost(server) from None
            counts.bytes_out += len(data)

        return command

    def _command_connection(self) -> socket.socket:
        """The connection of the commands. Raises `OSError` or `EOFError`."""
        self._check_open()
        if self._commands is None:
            self._commands = connect(self._server.address, self._timeout)
        return self._commands

    def _check_open(self) -> None:
        if self._canceled:
            raise EOFError

    def _take(self) -> socket.socket:
        """A connection that no other thread uses. Raises `OSError` or `EOFError`."""
        with self._lock:
            self._check_open()
            connection = self._free.pop() if self._free else None
        if connection is None:
            connection = connect(self._server.address, self._timeout)
        with self._lock:
            self._used.add(connection)
            if self._canceled:
                shut_down(connection)
        return connection

    def _give_back(self, connection: socket.socket) -> None:
        with self._lock:
            self._used.discard(connection)
            self._free.append(connection)

    def _drop(self, connection: socket.socket) -> None:
        with self._lock:
            self._used.discard(connection)
        connection.close()

    def set_timeout(self, seconds: float) -> None:
        """See `ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `ServiceClient`."""
        with self._lock:
            self._canceled = True
            for connection in self._used:
                shut_down(connection)

    def close(self) -> None:
        """See `ServiceClient`."""
        self.cancel()
        with self._lock:
            for connection in (*self._free, *filter(None, [self._commands])):
                connection.close()
            self._free.clear()


class PipePublisher:
    """Sends to each subscriber with a thread of its own, so that none holds the publisher."""

    def __init__(self, at: Endpoint) -> None:
        self.address = ""
        self._name = at.name
        self._senders: dict[PortRecord, Sender] = {}

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `Publisher`."""
        name = operation.name.encode()

        def publish(data: bytes, number: bytes) -> None:
            for sender in tuple(self._senders.values()):
                sender.put((name, number, data))
            counts.bytes_out += len(data)

        return BoundOperation(operation.encode_request, publish)

    def attach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        self._senders[subscriber] = Sender(self._name, subscriber.address)

    def detach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        if sender := self._senders.pop(subscriber, None):
            sender.close()

    def has_subscribers(self) -> bool:
        """See `Publisher`."""
        return bool(self._senders)

    def close(self) -> None:
        """See `Publisher`."""
        for subscriber in list(self._senders):
            self.detach(subscriber)


class Sender:
    """The thread that sends to one subscriber."""

    def __init__(self, name: str, address: str) -> None:
        self._address = address
        self._messages: deque[tuple[bytes, ...]] = deque(maxlen=SEND_DEPTH)
        self._changed = threading.Event()
        self._connection: socket.socket | None = None
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def put(self, message: tuple[bytes, ...]) -> None:
        """Send a message later; never waits."""
        self._messages.append(message)
        self._changed.set()

    def _run(self) -> None:
        with contextlib.suppress(OSError), connect(self._address, None) as connection:
            self._connection = connection
            while self._messages or not self._closed:
                self._changed.wait()
                self._changed.clear()
                while self._messages:
                    send(connection, *self._messages.popleft())

    def close(self) -> None:
        """Send what is left, and end the thread."""
        self._closed = True
        self._changed.set()
        self._thread.join(FLUSH_S)
        if self._connection:
            shut_down(self._connection)
