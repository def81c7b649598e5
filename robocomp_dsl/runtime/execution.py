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

    __slots__ = ("_acquire", "_holders", "_release", "_relieve")

    def __init__(self, threads: int = 1) -> None:
        lock = threading.Lock() if threads == 1 else threading.Semaphore(threads)
        self._acquire: Callable[..., bool] = lock.acquire
        self._release: Callable[[], None] = lock.release
        self._holders: set[int] = set()
        self._relieve: dict[int, Callable[[], None]] = {}

    def enter(self, timeout: float | None = None) -> bool:
        """Take the token; False when `timeout` s went by first."""
        if timeout is None:
            self._acquire()
        elif not self._acquire(True, timeout):
            return False
        self._holders.add(get_ident())
        return True

    def leave(self) -> None:
        """Give the token back."""
        self._holders.discard(get_ident())
        self._release()

    def __enter__(self) -> Self:
        self.enter()
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    @property
    def busy(self) -> bool:
        """Whether somebody runs."""
        return bool(self._holders)

    def pause(self) -> bool:
        """Before waiting for a remote answer: let others run. Tells whether to `resume`."""
        me = get_ident()
        if me not in self._holders:
            return False
        self._holders.remove(me)
        self._release()
        relieve = self._relieve.get(me)
        if relieve:
            relieve()
        return True

    def resume(self) -> None:
        """Take the token again after a `pause` that said so."""
        self._acquire()
        self._holders.add(get_ident())

    def on_pause(self, relieve: Callable[[], None] | None) -> None:
        """Whom to call when this thread pauses (None: nobody any more)."""
        if relieve:
            self._relieve[get_ident()] = relieve
        else:
            self._relieve.pop(get_ident(), None)
