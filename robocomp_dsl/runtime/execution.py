"""Who runs: the token that a component's handlers and its `compute` take in turn.

In: the number of threads that the CDSL allows. Out: at most so many run at a time. While one waits
for a remote answer it gives the token up, so that two components that call each other do not stop
for ever; the state of the worker may have changed when such a call returns.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import partial
from queue import Empty, SimpleQueue
from threading import get_ident
from typing import Self


class _Tokens:
    """A semaphore; that of the standard library is written in Python and ten times as slow."""

    __slots__ = ("_free", "release")

    def __init__(self, count: int) -> None:
        self._free: SimpleQueue[None] = SimpleQueue()
        for _ in range(count):
            self._free.put(None)
        self.release: Callable[[], None] = partial(self._free.put, None)

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """As of a lock."""
        try:
            self._free.get(blocking, None if timeout < 0 else timeout)
        except Empty:
            return False
        return True


class Execution:
    """The token of one component.

    `acquire`, `release`, `holders` and `relieve` are for the middlewares: what they do for every
    message is written out there, as the methods here do it; calling them costs as much again.
    """

    __slots__ = ("acquire", "holders", "release", "relieve")

    def __init__(self, threads: int = 1) -> None:
        lock = threading.Lock() if threads == 1 else _Tokens(threads)
        self.acquire: Callable[..., bool] = lock.acquire
        self.release: Callable[[], None] = lock.release
        self.holders: set[int] = set()
        self.relieve: dict[int, Callable[[], None]] = {}

    def enter(self, timeout: float | None = None) -> bool:
        """Take the token; False when `timeout` s went by first."""
        if timeout is None:
            self.acquire()
        elif not self.acquire(True, timeout):
            return False
        self.holders.add(get_ident())
        return True

    def leave(self) -> None:
        """Give the token back."""
        self.holders.discard(get_ident())
        self.release()

    def __enter__(self) -> Self:
        self.enter()
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    @property
    def busy(self) -> bool:
        """Whether somebody runs."""
        return bool(self.holders)

    def pause(self) -> bool:
        """Before waiting for a remote answer: let others run. Tells whether to `resume`."""
        me = get_ident()
        if me not in self.holders:
            return False
        self.holders.remove(me)
        self.release()
        relieve = self.relieve.get(me)
        if relieve:
            relieve()
        return True

    def resume(self) -> None:
        """Take the token again after a `pause` that said so."""
        self.acquire()
        self.holders.add(get_ident())

    def on_pause(self, relieve: Callable[[], None] | None) -> None:
        """Whom to call when this thread pauses (None: nobody any more)."""
        if relieve:
            self.relieve[get_ident()] = relieve
        else:
            self.relieve.pop(get_ident(), None)
