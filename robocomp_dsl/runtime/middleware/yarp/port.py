"""A port of YARP: one listening TCP socket, its incoming connections, and its name.

In: a name, a function for messages, and the outgoing connections. Out: a port that programs of YARP
connect, ask and write to.
"""

from __future__ import annotations

import contextlib
import logging
import socket
import threading
import time
from collections.abc import Callable

from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3, Profile
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage, MiddlewareError
from robocomp_dsl.runtime.middleware.tcp.stream import failure_reason
from robocomp_dsl.runtime.middleware.yarp.admin import answer_admin
from robocomp_dsl.runtime.middleware.yarp.incoming import Incoming
from robocomp_dsl.runtime.middleware.yarp.port_protocols import Outputs, Receiver
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream

MAX_CONNECTIONS = 256
"""Incoming connections of one port; further ones are closed at once."""
log = logging.getLogger("robocomp")


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
        self._throttle = Throttle()
        self._lock = threading.Lock()
        self._connections: set[Incoming] = set()
        self._closed = False
        try:
            self._socket = socket.create_server(at)
        except (OSError, OverflowError) as error:
            where = f"{at[0]}:{at[1]}"
            raise MiddlewareError(
                f"YARP cannot listen at {where}: {failure_reason(error)}"
            ) from None
        self.host = at[0]
        self.number: int = self._socket.getsockname()[1]
        self._thread = threading.Thread(target=self._accept, name=f"yarp {name}", daemon=True)
        self._thread.start()

    def _accept(self) -> None:
        while not self._closed:
            try:
                accepted, _ = self._socket.accept()
            except OSError:
                if self._closed:
                    return
                # Too many open files: the connection stays in the queue of the system.
                time.sleep(0.1)
                continue
            self._start(YarpStream(accepted))

    def _start(self, stream: YarpStream) -> None:
        incoming = Incoming(self, stream, self.profile)
        with self._lock:
            accepted = not self._closed and len(self._connections) < MAX_CONNECTIONS
            if accepted:
                self._connections.add(incoming)
        if not accepted:
            stream.close()
            return
        name = f"yarp {self.name} input"
        threading.Thread(target=self._serve, args=(incoming,), name=name, daemon=True).start()

    def _serve(self, incoming: Incoming) -> None:
        try:
            incoming.run()
        except Exception as error:
            text = describe_error(error)
            log.error("%s: a connection failed: %s", self.name, text)  # noqa: TRY400 - described
        finally:
            with self._lock:
                self._connections.discard(incoming)

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
        self.report_malformed(sender, error)
        reply = self.receiver.reject(error) if self.receiver else []
        return None if command == "D" else reply

    def unwritable(self, error: EncodeError) -> Bottle:
        """What to reply instead of a reply that cannot be written."""
        return self.receiver.unwritable(error) if self.receiver else []

    def report_malformed(self, sender: str, error: MalformedMessage) -> None:
        """Log invalid bytes, limited in rate."""
        if self._throttle.allows("malformed"):
            log.warning("%s: %s sent an invalid message: %s", self.name, sender or "a peer", error)

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
        with self._lock:
            self._closed = True
            connections = list(self._connections)
        # `shutdown` wakes the thread that accepts; `close` alone would not.
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        for each in connections:
            each.close()
        if self._thread is not threading.current_thread():
            self._thread.join(1.0)
