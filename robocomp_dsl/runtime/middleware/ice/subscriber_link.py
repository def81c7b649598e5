"""Sends the publications of one port to one subscriber, and never waits for it for long.

In: encoded publications. Out: oneway messages; or, if the port is reliable, messages that the
subscriber acknowledges. A subscriber that receives nothing may hold the publisher once, for
`HOLD_S` or that of `bounded_queue`; after that it loses messages until it receives again.
"""

from __future__ import annotations

import contextlib
import logging
import threading
from collections import deque
from typing import Any

import Ice

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.middleware.ice.communicator import reason

HOLD_S = 0.03
"""How long a subscriber may hold a publication that is not acknowledged."""
DEPTH = 256
"""Publications on their way to one subscriber, if the port states no depth."""

log = logging.getLogger("robocomp")


class IceSubscriberLink:
    """One subscriber. `is_broken` is set when a message could not be sent."""

    def __init__(self, proxy: Any, name: str, depth: int | None, *, reliable: bool) -> None:
        self.name = name
        self.is_broken = False
        self._reliable = reliable
        self._depth = depth or DEPTH
        self._pending: deque[Any] = deque()
        self._hold_s = bounded_queue.HOLD_S if reliable else HOLD_S
        self._stalled = False
        self._lock = threading.Lock()
        self._throttle = Throttle()
        plain = proxy.ice_twoway() if reliable else proxy.ice_oneway()
        self._send_async = plain.ice_invokeAsync
        self._send = plain.ice_invocationTimeout(int(HOLD_S * 1000)).ice_invoke
        # The first message is asynchronous, because it establishes the connection.
        self._may_block = not reliable
        self._is_connected = False

    def send(self, name: str, mode: Any, data: bytes, counts: OperationCounts) -> None:
        """Send one message; failures are counted as drops."""
        with self._lock:
            pending = self._pending
            while pending and self._is_done(pending[0]):
                self._finish(pending.popleft(), counts)
            if self._may_block and self._is_connected and not pending:
                self._send_oneway(name, mode, data, counts)
            elif self._has_room(counts):
                try:
                    pending.append(self._send_async(name, mode, data))
                except Ice.Exception as error:
                    self._failed(error, counts)

    def _send_oneway(self, name: str, mode: Any, data: bytes, counts: OperationCounts) -> None:
        try:
            self._send(name, mode, data)
        except Ice.InvocationTimeoutException:
            # The subscriber receives nothing: later messages are queued, the oldest is dropped.
            self._is_connected = False
            self._held(counts)
        except Ice.Exception as error:
            self._is_connected = False
            self._failed(error, counts)

    def _is_done(self, future: Any) -> bool:
        return bool(future.done() if self._reliable else future.is_sent() or future.done())

    def _finish(self, future: Any, counts: OperationCounts) -> None:
        """A message was sent, acknowledged, or failed."""
        self._stalled = False
        error = future.exception() if future.done() and not future.cancelled() else None
        if error is None:
            self._is_connected = True
        else:
            self._failed(error, counts)

    def _has_room(self, counts: OperationCounts) -> bool:
        """Make room among the messages on their way; False if the new message must be dropped."""
        pending = self._pending
        if len(pending) < self._depth:
            return True
        if not self._reliable:
            pending.popleft().cancel()
            counts.drops += 1
            return True
        if not self._stalled:
            with contextlib.suppress(Ice.Exception):
                pending[0].result(self._hold_s)
            if self._is_done(pending[0]):
                self._finish(pending.popleft(), counts)
                return True
            self._stalled = True
            self._held(counts)
            return False
        counts.drops += 1
        return False

    def _held(self, counts: OperationCounts) -> None:
        counts.drops += 1
        if self._throttle.allows("held"):
            log.warning(
                "%s receives nothing and held %s.%s for %g ms; until it does, it loses messages",
                *(self.name, counts.port, counts.operation, self._hold_s * 1000),
            )

    def _failed(self, error: Exception, counts: OperationCounts) -> None:
        counts.drops += 1
        self.is_broken = True
        self._is_connected = False
        if self._throttle.allows("failed"):
            log.debug("%s cannot be reached: %s", self.name, reason(error))

    def close(self) -> None:
        """Drop the messages that are still on their way."""
        with self._lock:
            while self._pending:
                self._pending.popleft().cancel()
