"""A port of YARP: one listening TCP socket, its incoming connections, and its name.

In: a name, a function for messages, and the outgoing connections. Out: a port that programs of YARP
connect, ask and write to.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3, Profile
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage
from robocomp_dsl.runtime.middleware.tcp.listener import TcpListener
from robocomp_dsl.runtime.middleware.yarp.admin import answer_admin
from robocomp_dsl.runtime.middleware.yarp.incoming import Incoming
from robocomp_dsl.runtime.middleware.yarp.port_protocols import Outputs, Receiver
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream

MAX_CONNECTIONS = 256
"""Incoming connections of one port."""


class YarpPort:
    """A listening port. Raises `MiddlewareError` if it cannot listen."""

    def __init__(
        self,
        name: str,
        at: tuple[str, int],
        receiver: Receiver | None = None,
        outputs: Outputs | None = None,
        profile: Profile = PROFILE_3,
        *,
        is_rpc: bool = False,
    ) -> None:
        self.name = name
        self.receiver = receiver
        self.outputs = outputs
        self.profile = profile
        self.is_rpc = is_rpc
        self.properties: dict[str, Bottle] = {}
        self._lock = threading.Lock()
        self._connections: set[Incoming] = set()
        self._listener = TcpListener(name, "YARP", at, YarpStream, self._serve, MAX_CONNECTIONS)
        self.host, self.number = at[0], self._listener.number
        self._listener.start()

    def _serve(self, stream: YarpStream) -> bool:
        incoming = Incoming(self, stream, self.profile)
        with self._lock:
            self._connections.add(incoming)
        try:
            incoming.run()
        finally:
            with self._lock:
                self._connections.discard(incoming)
        return False

    def connected(self, incoming: Incoming) -> None:
        """A connection has told its name and carrier."""

    def name_requests(self, stream: YarpStream) -> Callable[[], None] | None:
        """What serves the requests of the name server's own carrier; None: no name server."""
        del stream
        return None

    def inputs(self) -> dict[str, str]:
        """The carriers of the incoming connections, by the names of their senders."""
        with self._lock:
            connections = list(self._connections)
        return {each.sender: each.carrier for each in connections if each.sender.startswith("/")}

    def disconnect_input(self, name: str) -> bool:
        """Close the connections from the port `name`; returns whether there were any."""
        with self._lock:
            found = [each for each in self._connections if each.sender == name]
        for each in found:
            each.close()
        return bool(found)

    def handle(
        self, incoming: Incoming, command: str, bottle: Bottle, size: int, envelope: str
    ) -> Bottle | None:
        """Handle one message: `a` admin, `d` data with a reply, `D` data."""
        del incoming
        if command == "a":
            return answer_admin(self, bottle)
        wants_reply = command == "d"
        if self.receiver is None:
            return [] if wants_reply else None
        reply = self.receiver.receive(bottle, size, envelope, wants_reply=wants_reply)
        if not wants_reply:
            return None
        # The sender waits for a Bottle; without one it would take the ack for it.
        return [] if reply is None else reply

    def malformed(self, sender: str, error: MalformedMessage, command: str) -> Bottle | None:
        """A message cannot be read: report it, and return the reply if one is expected."""
        if self.receiver is None:
            self.report_malformed(sender, error)
            return None if command == "D" else []
        text = f"{error.reason} (from {sender or 'a program'} at {self.name})"
        reply = self.receiver.reject(MalformedMessage(text, error.path, error.offset))
        return None if command == "D" else reply

    def unwritable(self, error: EncodeError) -> Bottle:
        """What to reply instead of a reply that cannot be written."""
        return self.receiver.unwritable(error) if self.receiver else []

    def report_malformed(self, sender: str, error: MalformedMessage) -> None:
        """Log invalid bytes, limited in rate."""
        text = f"{sender or 'a peer'} sent an invalid message: {error}"
        self._listener.report("malformed", text)

    def describe(self) -> list[str]:
        """What `yarp ping` and the command `*` show."""
        lines = [f"This is {self.name} at tcp://{self.host}:{self.number}/"]
        outputs = self.outputs.carriers() if self.outputs else {}
        lines += [
            f"There is an output connection from {self.name} to {name} using {carrier}"
            for name, carrier in outputs.items()
        ] or ["There are no outgoing connections"]
        lines += [
            f"There is an input connection from {name} to {self.name} using {carrier}"
            for name, carrier in self.inputs().items()
        ] or ["There are no incoming connections"]
        return lines

    def close(self) -> None:
        """Accept nothing more, and end all connections."""
        self._listener.close()
