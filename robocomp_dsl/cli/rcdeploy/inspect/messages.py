"""Messages of a published port, from the receiving thread to the command.

In: a client and a port. Out: an iterator of operation, arguments and time of arrival.
"""

from __future__ import annotations

import queue
import sys
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.target import PortTarget
from robocomp_dsl.runtime.component.interface import Pattern

if TYPE_CHECKING:
    from robocomp_dsl.client import DomainClient
    from robocomp_dsl.runtime.component.interface import Operation

MAX_WAITING = 1000
"""Messages that wait for a slow terminal; then the middleware drops the oldest, and counts."""
HINT_AFTER_S = 3.0
_POLL_S = 0.5


class Message(NamedTuple):
    """One message. `time` in s since 1970, `clock` in s of a clock that never jumps."""

    operation: str
    arguments: tuple[Any, ...]
    time: float
    clock: float


def published_operations(target: PortTarget, name: str = "") -> list[Operation]:
    """The operations that the port publishes, or the one called `name`. Raises `CliError`."""
    found = [
        operation
        for operation in target.port.interface.operations
        if operation.pattern in (Pattern.PUBLISH, Pattern.UNMARKED) and name in ("", operation.name)
    ]
    if not found:
        what = f"{target.component}.{target.port.name}" + (f".{name}" if name else "")
        raise CliError(EXIT_FINDINGS, f"`{what}` is not published")
    return found


class MessageStream:
    """The messages of some operations of a port, from now on."""

    def __init__(
        self, client: DomainClient, target: PortTarget, operations: list[Operation]
    ) -> None:
        self._client = client
        self._target = target
        self._queue: queue.Queue[Message] = queue.Queue(MAX_WAITING)
        handlers = {operation.name: self._handler(operation.name) for operation in operations}
        port = target.port
        self._counts = [client.statistics.of(port.name, each.name) for each in operations]
        client.subscribe(port.interface, target.component, port.name, handlers)

    def _handler(self, operation: str) -> Callable[..., None]:
        put = self._queue.put

        def handle(*arguments: Any) -> None:
            put(Message(operation, arguments, time.time(), time.monotonic()))

        return handle

    def __iter__(self) -> Iterator[Message]:
        """Messages without end; a note on stderr if none comes."""
        start, has_hint = time.monotonic(), False
        while True:
            message = self.next(_POLL_S)
            if message is not None:
                has_hint = True
                yield message
            elif not has_hint and time.monotonic() > start + HINT_AFTER_S:
                has_hint = True
                name = f"{self._target.component}.{self._target.port.name}"
                print(f"{name} has published nothing for {HINT_AFTER_S:g} s", file=sys.stderr)

    def next(self, timeout: float) -> Message | None:
        """The next message; None after `timeout` s."""
        try:
            return self._queue.get(timeout=timeout)
        except queue.Empty:
            return None

    @property
    def received_bytes(self) -> int:
        """Bytes of all messages so far."""
        return sum(counts.bytes_in for counts in self._counts)

    @property
    def received(self) -> int:
        """The number of messages so far, with those that wait."""
        return sum(counts.calls for counts in self._counts)

    @property
    def lost(self) -> int:
        """Messages that were published and did not arrive, as of the latest `refresh`."""
        return sum(counts.drops for counts in self._counts)

    def refresh(self) -> None:
        """Bring `lost` up to date."""
        self._client.statistics.refresh()

    def report_lost(self) -> None:
        """Tell on stderr what did not arrive."""
        self.refresh()
        if self.lost:
            print(f"{self.lost} messages were lost: this program was too slow", file=sys.stderr)
