"""One incoming connection of a port, over any carrier.

In: a connected socket. Out: messages and admin commands for the port; its replies and acks.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from robocomp_dsl.runtime.codec.bottle.binary_reader import read_binary
from robocomp_dsl.runtime.codec.bottle.binary_writer import write_binary
from robocomp_dsl.runtime.codec.bottle.profile import Profile
from robocomp_dsl.runtime.codec.bottle.text_reader import Continuation, read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.runtime.middleware.yarp import wire
from robocomp_dsl.runtime.middleware.yarp.port_protocols import ListeningPort
from robocomp_dsl.runtime.middleware.yarp.stream import MAX_LINE, YarpStream

SET_UP_S = 10.0
"""A client that connects must name its carrier within this time."""
_NAME_SERVER = b"NAME_SER"
_TEXT_CARRIERS = {b"CONNECT ": "text", b"CONNACK ": "text_ack"}
_ACK_LINE = "<ACK>"
_UNKNOWN = (
    "Port command not understood.",
    "Type d to send data.",
    'Type "?" for a list of commands.',
)
_HELP = (
    "This is the help of the port:",
    "*  describe the port",
    "d  data, which is replied to; the next line is the data",
    "D  data without a reply; the next line is the data",
    "a  administrative command; the next line is the command",
    "q  close the connection",
)


class Incoming:
    """A connection. `sender` is the name of the other port."""

    def __init__(self, port: ListeningPort, stream: YarpStream, profile: Profile) -> None:
        self.sender = ""
        self.carrier = ""
        self._port = port
        self._stream = stream
        self._profile = profile

    def run(self) -> None:
        """Serve the connection until it ends. Raises `ConnectionLost`."""
        try:
            self._stream.deadline = time.monotonic() + SET_UP_S
            serve = self._accept()
            self._stream.deadline = None
            if serve:
                serve()
        except MalformedMessage as error:
            if self.carrier:
                self._port.malformed(self.sender, error, "D")
            else:
                self._port.report_malformed(self.sender, error)

    def close(self) -> None:
        """End the connection; called from any thread."""
        self._stream.close()

    def _accept(self) -> Callable[[], None] | None:
        """The function that serves the carrier; None: close the connection."""
        stream = self._stream
        head = stream.take(8)
        if head == _NAME_SERVER:
            return self._port.name_requests(stream)
        if head in _TEXT_CARRIERS:
            self.carrier = _TEXT_CARRIERS[head]
            self.sender = stream.line().strip()
            self._port.connected(self)
            stream.send_line(f"Welcome {self.sender}")
            return self._serve_text
        self.carrier = wire.carrier_of(head)
        if not self.carrier:
            return None
        self.sender = wire.read_sender(stream)
        self._port.connected(self)
        stream.send(wire.number(self._port.number))
        return self._serve_binary

    def _serve_binary(self) -> None:
        stream, acks = self._stream, self.carrier == "tcp"
        while True:
            message = wire.read_message(stream)
            reply = None
            if message.command in {"D", "d", "a"}:
                reply = self._handle_binary(message)
            if reply is not None:
                stream.send(self._written(reply))
            if acks:
                stream.send(wire.ACK)
            if message.command == "q":
                return

    def _handle_binary(self, message: wire.YarpMessage) -> Bottle | None:
        try:
            bottle = read_binary(message.payload, self._profile)
        except MalformedMessage as error:
            return self._port.malformed(self.sender, error, message.command)
        return self._port.handle(self, message.command, bottle, message.size, message.envelope)

    def _written(self, reply: Bottle) -> bytes:
        try:
            return write_binary(reply, self._profile)
        except EncodeError as error:
            return write_binary(self._port.unwritable(error), self._profile)

    def _serve_text(self) -> None:
        acks = self.carrier == "text_ack"
        while True:
            command, _, envelope = self._stream.line().partition(" ")
            lines: tuple[str, ...] = ()
            if command in {"D", "d", "a", "do"}:
                kind = "D" if command == "do" else command
                reply = self._handle_text(kind, envelope)
                lines = (write_text(reply),) if reply is not None else ()
            elif command == "*":
                lines = tuple(self._port.describe())
            elif command == "?":
                lines = _HELP
            elif command not in {"q", "~*"}:
                lines = _UNKNOWN
            for line in (*lines, _ACK_LINE) if acks else lines:
                self._stream.send_line(line)
            if command in {"q", "~*"}:
                return

    def _handle_text(self, command: str, envelope: str) -> Bottle | None:
        text = self._text()
        try:
            bottle = read_text(text, self._profile.version)
        except MalformedMessage as error:
            return self._port.malformed(self.sender, error, command)
        return self._port.handle(self, command, bottle, len(text), envelope)

    def _text(self) -> str:
        """A Bottle of one or several lines."""
        continuation = Continuation()
        lines: list[str] = []
        size = 0
        while True:
            lines.append(self._stream.line())
            size += len(lines[-1]) + 1
            if size > MAX_LINE:
                raise MalformedMessage(f"a Bottle in text has more than {MAX_LINE} bytes")
            if not continuation.feed(lines[-1]):
                return "\n".join(lines)
