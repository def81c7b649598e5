"""Calls the operations of one rpc port."""

from __future__ import annotations

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
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage, NoServer
from robocomp_dsl.runtime.middleware.tcp.client import TcpClient, TimedCall
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.middleware.yarp import outgoing
from robocomp_dsl.runtime.middleware.yarp.addresses import parse_address
from robocomp_dsl.runtime.middleware.yarp.description import MAX_MESSAGE_BYTES
from robocomp_dsl.runtime.middleware.yarp.outgoing import Resolve
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream
from robocomp_dsl.runtime.presence.port_record import PortRecord

_TEXT = ("text", "text_ack")


class YarpServiceClient(TcpClient[YarpStream]):
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
        super().__init__(server, timeout)
        self._layout = layout
        self._address = parse_address(server.address, at.name)
        self._sender = sender
        self._resolve = resolve
        self._profile = profile

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
            call = TimedCall(what, timeout)
            data = outgoing.message_bytes(self._address.carrier, *payload, "d")

            def exchange(stream: YarpStream) -> Bottle:
                stream.send(data)
                counts.bytes_out += len(data)
                reply, size = self._read_reply(stream)
                counts.bytes_in += size
                return reply

            reply = self._exchange(call, exchange)
            if messages.is_failure(reply, operation, layout, external=external):
                raise messages.decode_failure(operation, what, reply)
            try:
                return decode(reply)
            except MalformedMessage as error:
                raise call.malformed(error) from None

        return query

    def _command(self, operation: Operation, counts: OperationCounts) -> Callable[..., None]:
        timeout = self._timeout
        what = f"{self._server.name}.{operation.name}"

        def command(payload: tuple[Bottle, bytes]) -> None:
            call = TimedCall(what, timeout)
            data = outgoing.message_bytes(self._address.carrier, *payload, "D")

            def send(stream: YarpStream) -> None:
                stream.send(data)
                outgoing.read_ack(stream, self._address.carrier)

            self._send_in_order(call, send)
            counts.bytes_out += len(data)

        return command

    def _connect(self, call: TimedCall, service: str) -> YarpStream:
        del service
        try:
            address = self._resolve(self._address)
            return outgoing.open_connection(address, self._sender, call.remaining)
        except ConnectionLost as error:
            if self._is_external and not error.timed_out:
                raise NoServer(
                    f"{self._server.component} ({self._address}) cannot be reached: {error};"
                    " start it, or correct its address"
                ) from None
            raise

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
