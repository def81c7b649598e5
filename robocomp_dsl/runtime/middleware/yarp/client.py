"""Calls the operations of one rpc port.

Each call has a connection for itself while it waits for its reply; connections are kept and used
again. Commands share one, so that they arrive in order.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.codec.bottle import messages
from robocomp_dsl.runtime.codec.bottle.binary_reader import read_stream
from robocomp_dsl.runtime.codec.bottle.binary_writer import write_binary
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.profile import Profile
from robocomp_dsl.runtime.codec.bottle.text_reader import Continuation, read_text
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.component.interface import Operation, Pattern
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage, NoServer, Timeout
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.middleware.yarp import outgoing
from robocomp_dsl.runtime.middleware.yarp.addresses import parse_address
from robocomp_dsl.runtime.middleware.yarp.description import MAX_MESSAGE_BYTES
from robocomp_dsl.runtime.middleware.yarp.outgoing import Resolve
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream
from robocomp_dsl.runtime.presence.port_record import PortRecord

_TEXT = ("text", "text_ack")


class YarpServiceClient:
    """Calls the server of one record."""

    def __init__(
        self,
        at: Endpoint,
        server: PortRecord,
        sender: str,
        resolve: Resolve,
        profile: Profile,
        timeout: float,
        layout: Layout = Layout.YARP,
    ) -> None:
        """Raises `MiddlewareError` for an invalid address."""
        self._layout = layout
        self._server = server
        self._is_external = not server.hash
        self._address = parse_address(server.address, at.name)
        self._sender = sender
        self._resolve = resolve
        self._profile = profile
        self._timeout = timeout
        self._lock = threading.Lock()
        self._command_lock = threading.Lock()
        self._idle: list[YarpStream] = []
        self._opened: set[YarpStream] = set()
        self._command_stream: YarpStream | None = None
        self._cancelled = False

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `ServiceClient`."""
        convert = messages.request_encoder(operation, self._layout)

        def encode(arguments: tuple[Any, ...]) -> tuple[Bottle, bytes]:
            bottle = convert(arguments)
            data = write_binary(bottle, self._profile)
            if len(data) > MAX_MESSAGE_BYTES:
                raise EncodeError(f"a message has at most {MAX_MESSAGE_BYTES} bytes")
            return bottle, data

        if operation.pattern is Pattern.COMMAND:
            return BoundOperation(encode, self._command(operation, counts))
        return BoundOperation(encode, self._query(operation, counts))

    def _query(self, operation: Operation, counts: OperationCounts) -> Callable[..., Any]:
        external, timeout, layout = self._is_external, self._timeout, self._layout
        what = f"{self._server.name}.{operation.name}"
        decode = messages.reply_decoder(operation, layout, external=external)

        def query(payload: tuple[Bottle, bytes]) -> Any:
            deadline = time.monotonic() + timeout
            data = outgoing.message_bytes(self._address.carrier, *payload, "d")
            stream = self._take_stream(what, deadline, timeout)
            try:
                stream.send(data)
                counts.bytes_out += len(data)
                reply, size = self._read_reply(stream)
            except ConnectionLost as error:
                self._drop(stream)
                raise self._failure(error, what, timeout) from None
            except MalformedMessage as error:
                self._drop(stream)
                raise _malformed(what, error) from None
            except BaseException:
                self._drop(stream)
                raise
            counts.bytes_in += size
            self._keep(stream)
            if messages.is_failure(reply, operation, layout, external=external):
                raise messages.decode_failure(operation, what, reply)
            try:
                return decode(reply)
            except MalformedMessage as error:
                raise _malformed(what, error) from None

        return query

    def _command(self, operation: Operation, counts: OperationCounts) -> Callable[..., None]:
        timeout = self._timeout
        what = f"{self._server.name}.{operation.name}"

        def command(payload: tuple[Bottle, bytes]) -> None:
            deadline = time.monotonic() + timeout
            data = outgoing.message_bytes(self._address.carrier, *payload, "D")
            with self._command_lock:
                stream, self._command_stream = self._command_stream, None
                if stream is None or stream.is_closed():
                    if stream:
                        self._drop(stream)
                        if not self._is_external:
                            raise ServerLost(self._server.name)
                    stream = self._open(what, deadline, timeout)
                stream.deadline = deadline
                try:
                    stream.send(data)
                    outgoing.read_ack(stream, self._address.carrier)
                except ConnectionLost as error:
                    self._drop(stream)
                    raise self._failure(error, what, timeout) from None
                self._command_stream = stream
            counts.bytes_out += len(data)

        return command

    def _take_stream(self, what: str, deadline: float, timeout: float) -> YarpStream:
        """An idle connection that is still open, or a new one."""
        while True:
            with self._lock:
                if self._cancelled:
                    raise ServerLost(self._server.name)
                stream = self._idle.pop() if self._idle else None
            if stream is None:
                stream = self._open(what, deadline, timeout)
            elif stream.is_closed():
                self._drop(stream)
                continue
            stream.deadline = deadline
            return stream

    def _open(self, what: str, deadline: float, timeout: float) -> YarpStream:
        if self._cancelled:
            raise ServerLost(self._server.name)
        try:
            address = self._resolve(self._address)
            left = max(0.001, deadline - time.monotonic())
            stream = outgoing.open_connection(address, self._sender, left)
        except ConnectionLost as error:
            if self._is_external and not error.timed_out:
                raise NoServer(
                    f"{self._server.component} ({self._address}) cannot be reached: {error};"
                    " start it, or correct its address"
                ) from None
            raise self._failure(error, what, timeout) from None
        with self._lock:
            self._opened.add(stream)
            cancelled = self._cancelled
        if cancelled:
            self._drop(stream)
            raise ServerLost(self._server.name)
        return stream

    def _read_reply(self, stream: YarpStream) -> tuple[Bottle, int]:
        carrier = self._address.carrier
        if carrier in _TEXT:
            continuation = Continuation()
            lines = [stream.line()]
            while continuation.feed(lines[-1]):
                lines.append(stream.line())
            outgoing.read_ack(stream, carrier)
            text = "\n".join(lines)
            return read_text(text, self._profile.version), len(text)
        left = MAX_MESSAGE_BYTES

        def take(size: int) -> bytes:
            nonlocal left
            left -= size
            if left < 0:
                raise MalformedMessage(f"has more than {MAX_MESSAGE_BYTES} bytes")
            return stream.take(size)

        reply, size = read_stream(take, self._profile)
        outgoing.read_ack(stream, carrier)
        return reply, size

    def _failure(self, error: ConnectionLost, what: str, timeout: float) -> Exception:
        if self._cancelled:
            return ServerLost(self._server.name)
        if error.timed_out:
            return Timeout(f"{what} did not reply within {timeout:g} s")
        return ServerLost(f"{self._server.name}: the connection was lost ({error})")

    def _keep(self, stream: YarpStream) -> None:
        with self._lock:
            if not self._cancelled:
                self._idle.append(stream)
                return
        self._drop(stream)

    def _drop(self, stream: YarpStream) -> None:
        with self._lock:
            self._opened.discard(stream)
        stream.close()

    def set_timeout(self, seconds: float) -> None:
        """See `ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `ServiceClient`."""
        with self._lock:
            self._cancelled = True
            opened, self._opened = self._opened, set()
            self._idle.clear()
        for stream in opened:
            stream.close()

    def close(self) -> None:
        """See `ServiceClient`."""
        self.cancel()


def _malformed(what: str, error: MalformedMessage) -> MalformedMessage:
    return MalformedMessage(f"the reply of {what}: {error.reason}", error.path, error.offset)
