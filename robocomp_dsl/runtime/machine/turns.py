"""One after another: what several threads, or one from within, want done to the same thing.

In: functions. Out: each is called once, in order, never two at a time. Nobody waits for another
thread, for that one may be waiting for an answer that only the waiting one could give: who finds
somebody at work leaves the function to them.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

log = logging.getLogger("robocomp")


@dataclass(frozen=True, slots=True)
class _Turn:
    """A function; `within` is that during which it was asked for, None from another thread."""

    do: Callable[[], bool]
    within: _Turn | None


class Turns:
    """The functions that are to be called, and who is at it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: deque[_Turn] = deque()
        self._now: _Turn | None = None
        self._thread: int | None = None

    def take(self, do: Callable[[], bool]) -> bool:
        """Call `do` and what is asked for meanwhile; what `do` says, False where it is left.

        Raises the first failure, when all is done; what the failed one asked for is not done.
        """
        with self._lock:
            inside = self._thread == threading.get_ident()
            self._waiting.append(_Turn(do, self._now if inside else None))
            if self._thread is not None:
                return False
            self._thread = threading.get_ident()
        said: list[bool] = []
        failures: list[BaseException] = []
        while (one := self._next()) is not None:
            try:
                said.append(one.do())
            except BaseException as failure:
                failures.append(failure)
                self._forget(one)
        for more in failures[1:]:
            log.error("a state's method failed: %r", more)
        if failures:
            raise failures[0]
        return said[0]

    def _next(self) -> _Turn | None:
        """The next one; if there is none, nobody is at work any more."""
        with self._lock:
            self._now = self._waiting.popleft() if self._waiting else None
            if self._now is None:
                self._thread = None
            return self._now

    def _forget(self, failed: _Turn) -> None:
        with self._lock:
            self._waiting = deque(one for one in self._waiting if one.within is not failed)
