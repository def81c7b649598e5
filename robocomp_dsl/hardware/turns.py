"""Turns at something that only one thread may touch: first come, first served.

A lock of Python lets the thread that gave it back take it again at once, so that a simulation
which never rests would never let a caller in. Here the next one waits at the door and goes first.
"""

from __future__ import annotations

import threading


class Turns:
    """A lock that is taken in order; not reentrant."""

    def __init__(self) -> None:
        self._door = threading.Lock()
        self._room = threading.Lock()

    def __enter__(self) -> None:
        with self._door:
            self._room.acquire()

    def __exit__(self, *_: object) -> None:
        self._room.release()
