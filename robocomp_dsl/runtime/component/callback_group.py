"""Mutual exclusion of a component's handlers and its `compute`.

In: the number of threads that the CDSL file allows. Out: at most so many callbacks run at a time. A
callback that waits for a remote reply releases its slot, so that two components that call each
other do not deadlock; the state of the worker may have changed when such a call returns.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import partial
from queue import Empty, SimpleQueue
from threading import get_ident
from time import perf_counter_ns
from typing import Self


class _Semaphore:
    """A semaphore; `threading.Semaphore` is written in Python and ten times slower."""

    __slots__ = ("_free", "release")

    def __init__(self, count: int) -> None:
        self._free: SimpleQueue[None] = SimpleQueue()
        for _ in range(count):
            self._free.put(None)
        self.release: Callable[[], None] = partial(self._free.put, None)

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """See `threading.Lock.acquire`."""
        try:
            self._free.get(blocking, None if timeout < 0 else timeout)
        except Empty:
            return False
        return True


class CallbackGroup:
    """Mutually exclusive callback group of one component.

    `acquire`, `release`, `holders` and `handoffs` are public for the middlewares: they inline the
    methods of this class for every message, because a call would double the cost. `holders` are the
    threads that run a callback now, with the time at which it began (`perf_counter_ns`); the
    watchdog reads it. A thread that waits for a slot or for a remote reply is not among them.
    """

    __slots__ = ("acquire", "handoffs", "holders", "release")

    def __init__(self, threads: int = 1) -> None:
        lock = threading.Lock() if threads == 1 else _Semaphore(threads)
        self.acquire: Callable[..., bool] = lock.acquire
        self.release: Callable[[], None] = lock.release
        self.holders: dict[int, int] = {}
        self.handoffs: dict[int, Callable[[], None]] = {}

    def enter(self, timeout: float | None = None) -> bool:
        """Take a slot; False if none was free within `timeout` s."""
        if timeout is None:
            self.acquire()
        elif not self.acquire(True, timeout):
            return False
        self.holders[get_ident()] = perf_counter_ns()
        return True

    def leave(self) -> None:
        """Release the slot."""
        self.holders.pop(get_ident(), None)
        self.release()

    def __enter__(self) -> Self:
        self.enter()
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    @property
    def busy(self) -> bool:
        """Whether a callback runs."""
        return bool(self.holders)

    def pause(self) -> int:
        """Release the slot before waiting for a remote reply; returns what `resume` needs.

        That is the time at which the callback began; 0: this thread holds no slot.
        """
        me = get_ident()
        began = self.holders.pop(me, 0)
        if not began:
            return 0
        self.release()
        handoff = self.handoffs.get(me)
        if handoff:
            handoff()
        return began

    def resume(self, began: int) -> None:
        """Take the slot again after a `pause` that did not return 0."""
        self.acquire()
        self.holders[get_ident()] = began

    def on_release(self, handoff: Callable[[], None] | None) -> None:
        """Set the function to call when this thread pauses; None: no function."""
        if handoff:
            self.handoffs[get_ident()] = handoff
        else:
            self.handoffs.pop(get_ident(), None)
