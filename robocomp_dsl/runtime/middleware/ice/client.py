"""Calls one server over Ice, with a connection of its own.

Queries are synchronous calls in the thread of the caller: Ice's asynchronous calls take more than
twice as long. Closing the connection ends them.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable
from typing import Any

import Ice

from robocomp_dsl.runtime.codec.ice import codec
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import MalformedMessage, MiddlewareError, RemoteError
from robocomp_dsl.runtime.middleware.ice.addresses import split_proxies
from robocomp_dsl.runtime.middleware.ice.communicator import reason
from robocomp_dsl.runtime.middleware.ice.failures import decode_failure
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.slice_identifiers import operation_names


class IceServiceClient:
    """Calls the server of one record."""

    def __init__(
        self,
        communicator: Any,
        connection: str,
        at: Endpoint,
        server: PortRecord,
        timeout: float,
    ) -> None:
        """`connection` is a unique id. Raises `MiddlewareError` for an invalid address."""
        self._server = server
        self._timeout = timeout
        self._cancelled = False
        self._module = at.interface.name.rpartition("::")[0]
        self._names = operation_names(
            at.interface.name.rpartition("::")[2], (o.name for o in at.interface.operations)
        )
        first, second = split_proxies(server.address)
        queries = parse_proxy(communicator, first, server.name).ice_connectionId(connection)
        commands = parse_proxy(communicator, second, server.name).ice_connectionId(connection)
        self._queries, self._commands = queries, commands.ice_oneway()
        self._called: list[Any] = []

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `ServiceClient`."""
        encode = codec.request_encoder(operation)
        if operation.pattern is Pattern.COMMAND:
            return BoundOperation(encode, self._command(operation, counts))
        return BoundOperation(encode, self._query(operation, counts))

    def _query(self, operation: Operation, counts: OperationCounts) -> Callable[[bytes], Any]:
        invoke, name, mode = self._invoke(self._queries, operation)
        decode = codec.reply_decoder(operation)

        def query(data: bytes) -> Any:
            if self._cancelled:
                raise ServerLost(self._server.name)
            counts.bytes_out += len(data)
            try:
                succeeded, reply = invoke(name, mode, data)
            except Ice.Exception as error:
                raise self._failure(error, operation, len(data)) from None
            counts.bytes_in += len(reply)
            if not succeeded:
                raise self._declared(operation, reply)
            try:
                return decode(reply)
            except MalformedMessage as error:
                raise self._malformed(operation, error) from None

        return query

    def _command(self, operation: Operation, counts: OperationCounts) -> Callable[[bytes], None]:
        invoke, name, mode = self._invoke(self._commands, operation)

        def command(data: bytes) -> None:
            if self._cancelled:
                raise ServerLost(self._server.name)
            try:
                invoke(name, mode, data)
            except Ice.Exception as error:
                raise self._failure(error, operation, len(data)) from None
            counts.bytes_out += len(data)

        return command

    def _invoke(self, proxy: Any, operation: Operation) -> tuple[Callable[..., Any], str, Any]:
        limited = proxy.ice_invocationTimeout(max(1, math.ceil(self._timeout * 1000)))
        self._called.append(limited)
        return limited.ice_invoke, self._names[operation.name], mode_of(operation)

    def _failure(self, error: Exception, operation: Operation, size: int) -> Exception:
        """The exception for a call that brought no result."""
        server = self._server
        if self._cancelled:
            return ServerLost(server.name)
        is_external = not server.hash
        peer = f"{server.component} ({server.address})" if is_external else server.name
        what = f"{server.name}.{operation.name}"
        return decode_failure(error, what, peer, self._timeout, size, external=is_external)

    def _declared(self, operation: Operation, reply: bytes) -> Exception:
        try:
            return codec.error_decoder(operation.throws, self._module)(reply)
        except MalformedMessage as error:
            return self._malformed(operation, error)
        except codec.UnknownException as error:
            what = f"{self._server.name}.{operation.name}"
            return RemoteError(f"{what} failed: it raised {error}, which is not declared here")

    def _malformed(self, operation: Operation, error: MalformedMessage) -> MalformedMessage:
        what = f"the reply of {self._server.name}.{operation.name}: {error.reason}"
        return MalformedMessage(what, error.path, error.offset)

    def set_timeout(self, seconds: float) -> None:
        """See `ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `ServiceClient`."""
        self._cancelled = True
        for proxy in self._called:
            with contextlib.suppress(Ice.Exception):
                if connection := proxy.ice_getCachedConnection():
                    connection.close(Ice.ConnectionClose.Forcefully)
                else:  # a call may be establishing it
                    proxy.ice_getConnectionAsync().add_done_callback(_close_established)

    def close(self) -> None:
        """See `ServiceClient`."""
        self._cancelled = True
        for proxy in self._called:
            with contextlib.suppress(Ice.Exception):
                if connection := proxy.ice_getCachedConnection():
                    connection.close(Ice.ConnectionClose.Gracefully)


def _close_established(future: Any) -> None:
    if not future.cancelled() and not future.exception():
        future.result().close(Ice.ConnectionClose.Forcefully)


def mode_of(operation: Operation) -> Any:
    """Ice's mode of an operation, part of the wire: a plain server rejects the other mode."""
    return Ice.OperationMode.Idempotent if operation.idempotent else Ice.OperationMode.Normal


def parse_proxy(communicator: Any, text: str, peer: str) -> Any:
    """A proxy for `text`. Raises `MiddlewareError` if it is no proxy of Ice."""
    try:
        proxy = communicator.stringToProxy(text)
    except Ice.Exception as error:
        raise MiddlewareError(
            f"{peer}: `{text}` is no address of Ice ({reason(error)});"
            " write such as laser:tcp -h 10.0.0.2 -p 10001"
        ) from None
    if proxy is None:
        raise MiddlewareError(f"{peer}: the address is empty; write such as laser:tcp -p 10001")
    return proxy.ice_encodingVersion(Ice.Encoding_1_1)
