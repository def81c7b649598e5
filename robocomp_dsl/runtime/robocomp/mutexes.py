"""Locks as workers use them: handlers of other components run while `compute` runs.

In: the arguments of Qt's classes. Out: locks of Python with the names of Qt.
"""

from __future__ import annotations

import threading
from typing import Any, Self


class QMutex:
    """A lock; with `QMutex.Recursive` a thread may take it several times."""

    NonRecursive = 0
    Recursive = 1
    RecursionMode = None

    def __init__(self, mode: int = NonRecursive) -> None:
        self._lock: Any = threading.RLock() if mode == self.Recursive else threading.Lock()

    def lock(self) -> None:
        """Take the lock; wait until it is free."""
        self._lock.acquire()

    def tryLock(self, milliseconds: int = 0) -> bool:
        """Take the lock if it becomes free in time; negative: wait without limit."""
        timeout = -1.0 if milliseconds < 0 else milliseconds / 1000
        return bool(self._lock.acquire(timeout=timeout))

    def unlock(self) -> None:
        """Free the lock."""
        self._lock.release()


class QRecursiveMutex(QMutex):
    """A lock that a thread may take several times."""

    def __init__(self, *_: object) -> None:
        super().__init__(QMutex.Recursive)


class QMutexLocker:
    """Holds a lock until the end of its `with` block, `unlock`, or the end of its variable."""

    _holds = False  # also if the end of `compute` interrupts `__init__`

    def __init__(self, mutex: QMutex) -> None:
        self._mutex = mutex
        self.relock()

    def relock(self) -> None:
        """Take the lock again."""
        if not self._holds:
            self._mutex.lock()
            self._holds = True

    def unlock(self) -> None:
        """Free the lock."""
        if self._holds:
            self._holds = False
            self._mutex.unlock()

    def mutex(self) -> QMutex:
        """The lock."""
        return self._mutex

    def __enter__(self) -> Self:
        self.relock()
        return self

    def __exit__(self, *_: object) -> None:
        self.unlock()

    def __del__(self) -> None:
        self.unlock()
