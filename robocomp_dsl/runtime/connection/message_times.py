"""When messages of one connection arrive, for its deadline.

In: the begin and the end of each handler. Out: how late a message is. A queue that is not empty is
no silence: a gap counts only while no message is being handled.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation

_MIN_IDLE_S = 0.001
"""A message that comes sooner after its predecessor was in the queue already."""
MIN_CHECK_S = 0.001


class MessageTimes:
    """The messages of one subscription; `on_missed(seconds, counts)` is called once for a gap.

    `latest` is the time of the latest message, 0.0 before `start`.
    """

    def __init__(
        self, deadline: float, on_missed: Callable[[float, OperationCounts | None], None]
    ) -> None:
        self.deadline = deadline
        self.latest = 0.0
        self._on_missed = on_missed
        self._counts: OperationCounts | None = None
        self._finished = 0.0
        self._handling = 0
        self._reported = False
        self._lock = threading.Lock()

    def start(self) -> None:
        """A publisher is connected: the time of the first message begins."""
        with self._lock:
            if not self.latest:
                self.latest = self._finished = time.monotonic()

    def observe(self, operation: IncomingOperation) -> None:
        """Note the times of all messages of an operation from now on."""
        handle, counts = operation.handle, operation.counts
        self._counts = self._counts or counts
        begin, end = self._begin, self._end

        def handle_timed(arguments: tuple[Any, ...]) -> Any:
            begin(counts)
            try:
                return handle(arguments)
            finally:
                end()

        operation.handle = handle_timed

    def _begin(self, counts: OperationCounts) -> None:
        now = time.monotonic()
        with self._lock:
            gap = self._missed_gap(now)
            self.latest, self._counts = now, counts
            self._reported = False
            self._handling += 1
        if gap:
            self._on_missed(gap, counts)

    def _missed_gap(self, now: float) -> float:
        """The seconds since the last message if they exceed the deadline and are not reported."""
        if not self.deadline or not self.latest or self._reported or self._handling:
            return 0.0
        gap = now - self.latest
        is_queued = now - self._finished < min(self.deadline, _MIN_IDLE_S)
        return gap if gap > self.deadline and not is_queued else 0.0

    def _end(self) -> None:
        with self._lock:
            self._finished = time.monotonic()
            self._handling -= 1

    def check(self, now: float) -> float:
        """Report a gap that exceeds the deadline; returns when to check again."""
        if not self.deadline:
            return math.inf
        if not self.latest:
            return math.inf  # `start` is called when a publisher appears
        with self._lock:
            gap = self._missed_gap(now)
            if gap:
                self._reported = True
            counts = self._counts
            due = self.latest + self.deadline
        if gap:
            self._on_missed(gap, counts)
        return max(due, now + MIN_CHECK_S) if due > now else now + max(self.deadline, MIN_CHECK_S)
