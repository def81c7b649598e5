"""Accepts TCP connections, and serves each in a thread of its own.

In: connections. Out: calls of a function with the stream of each.
"""

from __future__ import annotations

import contextlib
import logging
import socket
import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost, TcpStream, failure_reason

log = logging.getLogger("robocomp")
_Stream = TypeVar("_Stream", bound=TcpStream)


class TcpListener(Generic[_Stream]):
    """Listens at host and port for `owner`, whose name messages contain, and accepts after `start`.

    At most `limit` connections are served at a time; further ones are closed at once. `serve`
    returns whether something else has taken over the connection, which is closed otherwise. Raises
    `MiddlewareError` if it cannot listen; `hint` tells what to do then.
    """

    def __init__(
        self,
        owner: str,
        middleware: str,
        at: tuple[str, int],
        stream_type: type[_Stream],
        serve: Callable[[_Stream], bool],
        limit: int,
        hint: str = "",
    ) -> None:
        self._owner = owner
        self._stream_type = stream_type
        self._serve_stream = serve
        self._limit = limit
        self._throttle = Throttle()
        self._lock = threading.Lock()
        self._streams: set[_Stream] = set()
        self._closed = False
        try:
            self._socket = socket.create_server(at, backlog=128)
        except (OSError, OverflowError) as error:
            where = f"{at[0]}:{at[1]}" if at[1] else at[0]
            raise MiddlewareError(
                f"{middleware} cannot listen at {where}: {failure_reason(error)}{hint}"
            ) from None
        self.number: int = self._socket.getsockname()[1]
        self._thread = threading.Thread(target=self._accept, name=f"listen {owner}", daemon=True)

    def start(self) -> None:
        """Accept connections from now on."""
        self._thread.start()

    @property
    def connections(self) -> int:
        """The number of connections that are served."""
        return len(self._streams)

    def _accept(self) -> None:
        while not self._closed:
            try:
                accepted, _ = self._socket.accept()
            except OSError:
                if self._closed:
                    return
                time.sleep(0.1)  # too many open files: the connection stays in the backlog
                continue
            stream = self._stream_type(accepted)
            with self._lock:
                has_room = not self._closed and len(self._streams) < self._limit
                if has_room:
                    self._streams.add(stream)
            if not has_room:
                stream.close()
                continue
            name = f"input {self._owner}"
            threading.Thread(target=self._serve, args=(stream,), name=name, daemon=True).start()

    def _serve(self, stream: _Stream) -> None:
        is_taken = False
        try:
            is_taken = self._serve_stream(stream)
        except ConnectionLost:
            pass
        except Exception as error:
            text = describe_error(error)
            log.error("%s: a connection failed: %s", self._owner, text)  # noqa: TRY400 - described
        finally:
            with self._lock:
                self._streams.discard(stream)
            if not is_taken:
                stream.close()

    def report(self, key: str, text: str) -> None:
        """Log a warning, limited in rate for each key."""
        if self._throttle.allows(key):
            log.warning("%s: %s", self._owner, text)

    def close(self) -> None:
        """Accept nothing more, and end the connections that have not been taken over."""
        with self._lock:
            self._closed = True
            streams = list(self._streams)
        # `shutdown` wakes the thread that accepts; `close` alone would not.
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        for stream in streams:
            stream.close()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join(1.0)
