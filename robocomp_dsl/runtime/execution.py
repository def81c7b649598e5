"""Who runs: the token that a component's handlers and its `compute` take in turn.

In: the number of threads that the CDSL allows. Out: at most so many run at a time. While one waits
for a remote answer it gives the token up, so that two components that call each other do not stop
for ever; the state of the worker may have changed when such a call returns.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from threading import get_ident
from typing import Self


class Execution:
    """The token of one component."""

    __slots__ = ("_holders", "_lock", "_relieve")

    def __init__(self, threads: int = 1) -> None:
        self._lock = threading.Lock() if threads == 1 else threading.Semaphore(threads)
        self._holders: set[int] = set()
        self._relieve: dict[int, Callable[[], None]] = {}

    def enter(self, timeout: float = -1) -> bool:
        """Take the token; False when `timeout` s went by first."""
        # A semaphore takes None for "for ever", a lock -1.
        if not (self._lock.acquire() if timeout < 0 else self._lock.acquire(timeout=timeout)):
            return False
        self._holders.add(get_ident())
        return True

    def leave(self) -> None:
        """Give the token back."""
        self._holders.discard(get_ident())
        self._lock.release()

    def __enter__(self) -> Self:
        self.enter()
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    def pause(self) -> bool:
        """Before waiting for a remote answer: let others run. Tells whether to `resume`."""
        me = get_ident()
        if me not in self._holders:
            return False
        self._holders.discard(me)
        self._lock.release()
        if self._relieve:
            relieve = self._relieve.get(me)
            if relieve:
                relieve()
        return True

    def resume(self) -> None:
        """Take the token again after a `pause` that said so."""
        self._lock.acquire()
        self._holders.add(get_ident())

    def on_pause(self, relieve: Callable[[], None] | None) -> None:
        """Whom to call when this thread pauses (None: nobody any more)."""
        if relieve:
            self._relieve[get_ident()] = relieve
        else:
            self._relieve.pop(get_ident(), None)
