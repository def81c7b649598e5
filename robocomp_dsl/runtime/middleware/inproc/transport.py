"""inproc transport: components of one process call each other directly.

A query runs in the thread of the caller, in the callback group of the server; a command or a
publication is queued and handled by a thread of the receiver. Components with generated packages of
their own get values of their own classes, through the codec as between processes. Where both sides
share the interface object, as in tests, values are passed by reference: receivers must not modify
them.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from itertools import count
from typing import Any

from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.thread_context import within
from robocomp_dsl.runtime.component.user_errors import message_of
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.errors import DeclaredError, RejectedByReceiver, RemoteError
from robocomp_dsl.runtime.middleware.transport import (
    BoundOperation,
    ServerLost,
    TransportContext,
)
from robocomp_dsl.runtime.presence.port_record import PortRecord

_numbers = count()
_ports: dict[str, InprocPort] = {}


def open_transport(_context: TransportContext) -> InprocTransport:
    """The in-process transport of one component."""
    return InprocTransport()


class InprocPort:
    """A served or subscribed port, found by its address."""

    def __init__(self, port: IncomingPort) -> None:
        self.address = f"{os.getpid()}-{next(_numbers)}"
        self.port = port
        self.queue = MessageQueue(port)
        _ports[self.address] = self

    def close(self) -> None:
        """See `PortServer`."""
        self.port.closed = True
        _ports.pop(self.address, None)
        self.queue.close()


class InprocTransport:
    """All connections of one component within the process."""

    def serve(self, port: IncomingPort) -> InprocPort:
        """See `Transport`."""
        return InprocPort(port)

    def subscribe(self, port: IncomingPort) -> InprocPort:
        """See `Transport`."""
        return InprocPort(port)

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> InprocServiceClient:
        """See `Transport`."""
        served = _ports.get(server.address)
        if served is None:  # it has been closed since
            raise ServerLost(server.name)
        return InprocServiceClient(at, served, timeout)

    def advertise(self, at: Endpoint) -> InprocPublisher:
        """See `Transport`."""
        return InprocPublisher(at)

    def close(self) -> None:
        """See `Transport`."""


class InprocServiceClient:
    """Calls a served port of this process."""

    def __init__(self, at: Endpoint, server: InprocPort, timeout: float) -> None:
        self._at = at
        self._server = server
        self._timeout = timeout

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:  # noqa: ARG002
        """See `ServiceClient`."""
        served = self._server.port.operations[operation.name]
        encode = _encoder(operation, served)
        if operation.pattern is Pattern.COMMAND:
            return BoundOperation(encode, self._command(served, _decoding(served, encode)))
        query = within(
            self._query(operation, served), self._server.port.at.component, self._at.component
        )
        if encode is None:
            return BoundOperation(None, query)
        decode, decode_reply = served.operation.decode_request, operation.decode_reply
        return BoundOperation(encode, lambda message: decode_reply(query(decode(message))))

    def _command(
        self, served: IncomingOperation, handle: Callable[[Any], Any]
    ) -> Callable[[Any], None]:
        port, put = self._server.port, self._server.queue.put

        def command(arguments: Any) -> None:
            if port.closed:
                raise ServerLost
            put(served, handle, arguments)

        return command

    def _query(
        self, operation: Operation, served: IncomingOperation
    ) -> Callable[[tuple[Any, ...]], Any]:
        name = f"{self._server.port.at.name}.{operation.name}"

        def convert(error: BaseException) -> BaseException:
            served.report(error)
            if isinstance(error, RejectedByReceiver):
                return error
            if declared := _as_declared(error, served.operation, operation.throws):
                return declared
            failure = RemoteError(f"{name} failed: {type(error).__name__}: {message_of(error)}")
            failure.__cause__ = error
            return failure

        is_same = served.operation is operation
        encode = None if is_same else served.operation.encode_reply
        return served.handle_for_caller(self._timeout, convert, ServerLost, encode)

    def set_timeout(self, seconds: float) -> None:
        """See `ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """Nothing to do: a call runs in the thread of the caller."""

    def close(self) -> None:
        """Nothing to release."""


class InprocPublisher:
    """Publishes into the queue of each subscriber."""

    def __init__(self, at: Endpoint) -> None:
        self.address = f"{os.getpid()}-{next(_numbers)}"
        self._source = at.name
        self._subscribers: dict[PortRecord, InprocPort] = {}

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:  # noqa: ARG002
        """See `Publisher`."""
        name = operation.name
        handles: dict[IncomingOperation, Callable[[Any], Any]] = {}

        def send(arguments: tuple[Any, ...], _number: bytes) -> None:
            data: Any = None
            for subscriber in tuple(self._subscribers.values()):
                served = subscriber.port.operations.get(name)
                if served is None:
                    continue
                if served.operation is operation:
                    subscriber.queue.put(served, served.handle, arguments)
                    continue
                if data is None:
                    data = operation.encode_request(arguments)
                handle = handles.get(served)
                if handle is None:
                    handle = handles[served] = _decoding(served, operation.encode_request)
                subscriber.queue.put(served, handle, data)

        return BoundOperation(None, send)

    def attach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        if port := _ports.get(subscriber.address):
            self._subscribers[subscriber] = port

    def detach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        self._subscribers.pop(subscriber, None)

    def has_subscribers(self) -> bool:
        """See `Publisher`."""
        return bool(self._subscribers)

    def close(self) -> None:
        """See `Publisher`."""
        self._subscribers.clear()


def _encoder(
    operation: Operation, served: IncomingOperation
) -> Callable[[tuple[Any, ...]], bytes] | None:
    """What makes a message of the caller's values; None if the server takes the values."""
    return None if served.operation is operation else operation.encode_request


def _decoding(served: IncomingOperation, encode: object) -> Callable[[Any], Any]:
    """A handle that takes what `encode` makes."""
    handle = served.handle
    if encode is None:
        return handle
    decode = served.operation.decode_request

    def decode_and_handle(message: bytes) -> Any:
        return handle(decode(message))

    return decode_and_handle


def _as_declared(
    error: BaseException, operation: Operation, throws: tuple[type[DeclaredError], ...]
) -> DeclaredError | None:
    """The exception as the caller declares it: two generated packages have classes of their own.

    None if the `operation` of the server does not declare it.
    """
    if not isinstance(error, DeclaredError):
        return None
    if isinstance(error, throws):
        return error
    if type(error) not in operation.throws:
        return None
    return throws[operation.throws.index(type(error))](*error._astuple())
