"""Turns at something that only one thread may touch: first come, first served.

A lock of Python lets the thread that gave it back take it again at once, so that a simulation
which never rests would never let a caller in. Here the next one waits at the door and goes first.
The one that works on it between the turns of all others rests until one of these is over.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress


class Quiet:
    """A turn of which the worker hears nothing: of somebody who only looks."""

    def __init__(self) -> None:
        self._door = threading.Lock()
        self._room = threading.Lock()

    def __enter__(self) -> None:
        with self._door:
            self._room.acquire()

    def __exit__(self, *_: object) -> None:
        self._room.release()


class Turns:
    """A lock that is taken in order; not reentrant. `quiet` is the same one for those who look."""

    def __init__(self) -> None:
        self.quiet = Quiet()
        self._silence = threading.Lock()  # held by nobody when somebody has rung
        self._silence.acquire()

    def __enter__(self) -> None:
        self.quiet.__enter__()

    def __exit__(self, *_: object) -> None:
        self.quiet.__exit__()
        if self._silence.locked():
            with suppress(RuntimeError):  # somebody else has just rung
                self._silence.release()

    @contextmanager
    def at_work(self) -> Iterator[None]:
        """The turn of the worker, which sees all that was done in turns before."""
        with self.quiet:
            self._silence.acquire(blocking=False)
            yield

    def rest(self, seconds: float) -> bool:
        """Of the worker: wait until somebody has had a turn since its own; whether that was so."""
        return self._silence.acquire(timeout=max(seconds, 0.0))
