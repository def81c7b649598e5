"""A fair lock for one worker thread and its visitors: threads get it in order of arrival.

A thread that releases a `threading.Lock` can immediately acquire it again, so a simulation that
never sleeps would starve all callers. Here the lock passes to the next thread in the queue.
Between its turns the worker sleeps until a visitor has held the lock.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress


class TicketLock:
    """A lock that is granted in order of arrival; not reentrant."""

    def __init__(self) -> None:
        self._queue = threading.Lock()
        self._lock = threading.Lock()

    def __enter__(self) -> None:
        with self._queue:
            self._lock.acquire()

    def __exit__(self, *_: object) -> None:
        self._lock.release()


class FairLock:
    """A lock that is granted in order of arrival, and wakes the worker; not reentrant.

    `reader` is the same lock for threads that only read: it does not wake the worker.
    """

    def __init__(self) -> None:
        self.reader = TicketLock()
        self._idle = threading.Lock()  # released after a visit, until the worker takes it
        self._idle.acquire()

    def __enter__(self) -> None:
        self.reader.__enter__()

    def __exit__(self, *_: object) -> None:
        self.reader.__exit__()
        if self._idle.locked():
            with suppress(RuntimeError):  # another visitor has just released it
                self._idle.release()

    @contextmanager
    def worker_turn(self) -> Iterator[None]:
        """Hold the lock as the worker, which sees the effects of all earlier visits."""
        with self.reader:
            self._idle.acquire(blocking=False)
            yield

    def wait_for_visitor(self, seconds: float) -> bool:
        """As the worker: wait for a visit after its last turn; False after `seconds`."""
        return self._idle.acquire(timeout=max(seconds, 0.0))
