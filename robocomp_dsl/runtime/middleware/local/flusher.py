"""Moves queued packets to slow subscribers, in one thread of a component.

In: links whose sockets were full. Out: their packets, as soon as there is room; the thread sleeps
while no link has a queue.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Protocol

from robocomp_dsl.runtime.component.user_errors import describe_error

SHORTEST_S = 0.001
LONGEST_S = 0.02
"""Period for subscribers that have received nothing for a while."""


class QueuedLink(Protocol):
    """A link with a queue of its own."""

    @property
    def has_queue(self) -> bool:
        """Whether packets wait."""

    def flush(self) -> bool:
        """Send what there is room for; returns whether that was anything."""


class Flusher:
    """The links with a queue, and the thread that empties it."""

    def __init__(self, fail: Callable[[str], None]) -> None:
        self._fail = fail
        self._links: set[QueuedLink] = set()
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._closed = False

    def add(self, link: QueuedLink) -> None:
        """Flush a link until its queue is empty."""
        with self._changed:
            self._links.add(link)
            self._changed.notify()
            if self._thread is None and not self._closed:
                self._thread = threading.Thread(target=self._run, name="local-flush", daemon=True)
                self._thread.start()

    def close(self) -> None:
        """End the thread."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        if self._thread and self._thread is not threading.current_thread():
            self._thread.join(1.0)

    def _run(self) -> None:
        try:
            self._flush_all()
        except BaseException as error:
            self._fail(f"the thread that flushes publications died: {describe_error(error)}")

    def _flush_all(self) -> None:
        period = SHORTEST_S
        while True:
            with self._changed:
                if self._closed:
                    return
                if self._links:
                    self._changed.wait(period)
                else:
                    self._changed.wait()
                links = list(self._links)
            moved = [link.flush() for link in links]
            with self._changed:
                # A link adds itself after a packet was queued: it stays, or it is added again.
                self._links -= {link for link in links if not link.has_queue}
            period = SHORTEST_S if any(moved) else min(2 * period, LONGEST_S)
