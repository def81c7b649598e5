"""Run-to-completion queue: functions of several threads are called one after the other.

In: functions. Out: each is called once, in order, never two at a time. A caller never blocks: if
another thread is processing the queue, that thread calls the function. (Blocking could deadlock:
the processing thread may wait for a reply that only the blocked one could give.)
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

log = logging.getLogger("robocomp")


@dataclass(frozen=True, slots=True)
class _Job:
    """A queued function; `parent` is the job that submitted it, None for another thread."""

    function: Callable[[], bool]
    parent: _Job | None


class RunToCompletionQueue:
    """Queue of functions, and the thread that processes it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[_Job] = deque()
        self._now: _Job | None = None
        self._thread: int | None = None

    def submit(self, function: Callable[[], bool]) -> bool:
        """Queue `function` and process the queue; returns its result, False if it was only queued.

        Raises the first failure after the queue is empty; jobs submitted by the failed job are
        discarded.
        """
        with self._lock:
            inside = self._thread == threading.get_ident()
            self._waiting.append(_Job(function, self._now if inside else None))
            if self._thread is not None:
                return False
            self._thread = threading.get_ident()
        results: list[bool] = []
        failures: list[BaseException] = []
        while (job := self._next()) is not None:
            try:
                results.append(job.function())
            except BaseException as failure:
                failures.append(failure)
                self._discard_children(job)
        for more in failures[1:]:
            log.error("a state's method failed: %r", more)
        if failures:
            raise failures[0]
        return results[0]

    def _next(self) -> _Job | None:
        """The next job; None marks the queue as idle."""
        with self._lock:
            self._now = self._waiting.popleft() if self._waiting else None
            if self._now is None:
                self._thread = None
            return self._now

    def _discard_children(self, failed: _Job) -> None:
        with self._lock:
            self._waiting = deque(job for job in self._waiting if job.parent is not failed)
