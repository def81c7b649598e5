"""The connections of a client to one server.

Each call has a connection for itself while it waits for its reply; connections are kept and used
again. Commands share one, so that they arrive in order.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

from robocomp_dsl.runtime.errors import MalformedMessage, Timeout
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost, TcpStream
from robocomp_dsl.runtime.middleware.transport import ServerLost
from robocomp_dsl.runtime.presence.port_record import PortRecord

_Stream = TypeVar("_Stream", bound=TcpStream)
_Reply = TypeVar("_Reply")


class TimedCall:
    """A call that has started; `what` names it in messages, `timeout` is in s."""

    __slots__ = ("deadline", "timeout", "what")

    def __init__(self, what: str, timeout: float) -> None:
        self.what = what
        self.timeout = timeout
        self.deadline = time.monotonic() + timeout

    @property
    def remaining(self) -> float:
        """The time until the deadline in s, always positive."""
        return max(0.001, self.deadline - time.monotonic())

    def malformed(self, error: MalformedMessage) -> MalformedMessage:
        """The error of a reply that cannot be read."""
        reason = f"the reply of {self.what}: {error.reason}"
        return MalformedMessage(reason, error.path, error.offset)


class TcpClient(Generic[_Stream]):
    """Calls the server of one record. A subclass connects; `service` is its kind of connection."""

    def __init__(self, server: PortRecord, timeout: float) -> None:
        self._server = server
        self._is_external = not server.hash
        self._timeout = timeout
        self._lock = threading.Lock()
        self._command_lock = threading.Lock()
        self._idle: dict[str, list[_Stream]] = {}
        self._opened: set[_Stream] = set()
        self._command_stream: _Stream | None = None
        self._cancelled = False

    def _connect(self, call: TimedCall, service: str) -> _Stream:
        """A new connection. Raises `ConnectionLost`."""
        raise NotImplementedError

    def _set_up(self, stream: _Stream, call: TimedCall, service: str) -> None:
        """Exchange what precedes the first call. May raise `ConnectionLost`."""

    def _exchange(
        self, call: TimedCall, exchange: Callable[[_Stream], _Reply], service: str = ""
    ) -> _Reply:
        """The result of `exchange` with a connection that no other call uses."""
        stream = self._take_stream(call, service)
        try:
            reply = exchange(stream)
        except ConnectionLost as error:
            self._drop(stream)
            raise self._failure(error, call) from None
        except MalformedMessage as error:
            self._drop(stream)
            raise call.malformed(error) from None
        except BaseException:
            self._drop(stream)
            raise
        with self._lock:
            if not self._cancelled:
                self._idle.setdefault(service, []).append(stream)
                return reply
        self._drop(stream)
        return reply

    def _send_in_order(self, call: TimedCall, send: Callable[[_Stream], None]) -> None:
        """Call `send` with the connection of the commands."""
        with self._command_lock:
            stream, self._command_stream = self._command_stream, None
            if stream is not None and stream.is_closed():
                self._drop(stream)
                if not self._is_external:
                    raise ServerLost(self._server.name)
                stream = None
            if stream is None:
                stream = self._open(call, "")
            stream.deadline = call.deadline
            try:
                send(stream)
            except ConnectionLost as error:
                self._drop(stream)
                raise self._failure(error, call) from None
            self._command_stream = stream

    def _take_stream(self, call: TimedCall, service: str) -> _Stream:
        """An idle connection that is still open, or a new one."""
        while True:
            with self._lock:
                idle = self._idle.get(service)
                stream = idle.pop() if idle else None
            if stream is None:
                stream = self._open(call, service)
            elif stream.is_closed():
                self._drop(stream)
                continue
            stream.deadline = call.deadline
            return stream

    def _open(self, call: TimedCall, service: str) -> _Stream:
        self._check_cancelled()
        try:
            stream = self._connect(call, service)
        except ConnectionLost as error:
            raise self._failure(error, call) from None
        with self._lock:
            self._opened.add(stream)
        try:
            self._check_cancelled()
            self._set_up(stream, call, service)
            self._check_cancelled()
        except ConnectionLost as error:
            self._drop(stream)
            raise self._failure(error, call) from None
        except BaseException:
            self._drop(stream)
            raise
        return stream

    def _check_cancelled(self) -> None:
        if self._cancelled:
            raise ServerLost(self._server.name)

    def _failure(self, error: ConnectionLost, call: TimedCall) -> Exception:
        if self._cancelled:
            return ServerLost(self._server.name)
        if error.timed_out:
            return Timeout(f"{call.what} did not reply within {call.timeout:g} s")
        return ServerLost(f"{self._server.name}: the connection was lost ({error})")

    def _drop(self, stream: _Stream) -> None:
        with self._lock:
            self._opened.discard(stream)
        stream.close()

    def set_timeout(self, seconds: float) -> None:
        """See `transport.ServiceClient`."""
        self._timeout = seconds

    def cancel(self) -> None:
        """See `transport.ServiceClient`."""
        with self._lock:
            self._cancelled = True
            opened, self._opened = self._opened, set()
            self._idle.clear()
        for stream in opened:
            stream.close()

    def close(self) -> None:
        """See `transport.ServiceClient`."""
        self.cancel()
