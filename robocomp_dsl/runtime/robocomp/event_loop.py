"""The event loop of a worker from RoboComp: what ran in Qt's main thread runs one at a time.

In: functions to call now or after a delay, from any thread. Out: each is called in order, in the
thread of the loop, and never while `compute` runs. Handlers of other components do not belong to
it: as with Ice they run in other threads, also while a function of the loop runs.
"""

from __future__ import annotations

import ctypes
import heapq
import itertools
import threading
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from robocomp_dsl.runtime.clock import TIME_DIGITS, Clock, WakeEvent
from robocomp_dsl.runtime.component.user_errors import log_failure

STOP_GRACE_S = 0.3
"""Time after a stop request before a function that still runs is interrupted."""


class WorkerStopped(SystemExit):
    """Raised in a function that runs when the component stops, such as an endless loop."""


class EventLoop:
    """The loop of one worker. Functions may be posted before `start`; they run after it."""

    _current = threading.local()
    _latest: EventLoop | None = None

    def __init__(self) -> None:
        EventLoop._latest = self
        self.application: Any = None
        self.leave: Callable[[SystemExit], None] = lambda _: None
        self._lock = threading.RLock()
        self._guard = threading.Lock()
        self._posted: deque[Callable[[], object]] = deque()
        self._delayed: list[tuple[float, int, Callable[[], object]]] = []
        self._numbers = itertools.count()
        self._wake = WakeEvent()
        self._clock: Clock | None = None
        self._waiting: list[tuple[float, Callable[[], object]]] = []
        self._running: int | None = None
        self._left = threading.Event()
        self._left.set()

    @classmethod
    def current(cls) -> EventLoop:
        """The loop to which the calling thread belongs, or else the latest of this process."""
        loop: EventLoop | None = getattr(cls._current, "loop", None) or cls._latest
        return loop or EventLoop()

    @property
    def stopped(self) -> bool:
        """Whether the component stops."""
        return self._wake.stopped

    @property
    def is_here(self) -> bool:
        """Whether the calling thread runs a function of this loop."""
        return self._running == threading.get_ident()

    def start(self, clock: Clock, name: str) -> None:
        """Start the thread; delays are those of `clock`."""
        self._clock = clock
        for seconds, function in self._waiting:
            self.call_later(seconds, function)
        self._waiting.clear()
        threading.Thread(target=self._run, name=f"{name}.events", daemon=True).start()

    def stop(self) -> None:
        """End the thread, and interrupt the function that runs."""
        self._wake.stop()
        if not self._left.is_set():
            threading.Thread(target=self._interrupt, daemon=True).start()

    def post(self, function: Callable[[], object]) -> None:
        """Call a function as soon as the current one has returned."""
        self._posted.append(function)
        self._wake.set()

    def call_later(self, seconds: float, function: Callable[[], object]) -> None:
        """Call a function after a delay on the component's clock."""
        if self._clock is None:
            self._waiting.append((seconds, function))
            return
        moment = round(self._clock.now() + seconds, TIME_DIGITS)
        with self._guard:
            heapq.heappush(self._delayed, (moment, next(self._numbers), function))
        self._wake.set()

    @contextmanager
    def entered(self) -> Iterator[None]:
        """The calling thread runs a function of the loop; at the end it runs what was posted."""
        with self._lock:
            outer, before = self._running, getattr(self._current, "loop", None)
            self._left.clear()
            self._running, self._current.loop = threading.get_ident(), self
            try:
                yield
                if outer is None:
                    self._run_posted()
            finally:
                with self._guard:
                    self._running, self._current.loop = outer, before
                    if outer is None:
                        self._left.set()
                        _raise_in(threading.get_ident(), None)

    def run_due(self) -> None:
        """Run what is posted or due, during a function of the loop."""
        self._run_posted()
        while self._clock is not None and not self.stopped:
            function = self._next(self._clock)
            if function is None:
                return
            function()

    def _run_posted(self) -> None:
        """Run the functions that are posted now; those that they post run later."""
        for _ in range(len(self._posted)):
            if self._posted and not self.stopped:
                self._posted.popleft()()

    def _run(self) -> None:
        clock = self._clock
        while clock and not self.stopped:
            self._wake.clear()
            self._run_next(clock)
            with self._guard:
                due = self._delayed[0][0] if self._delayed else None
            if not self._posted and not self.stopped:
                clock.wait_until(due, self._wake)

    def _run_next(self, clock: Clock) -> None:
        """Run the next function; as with Qt an error is logged, and the loop continues."""
        try:
            with self.entered():
                function = self._next(clock)
                if function is not None and not self.stopped:
                    function()
        except WorkerStopped:
            return
        except SystemExit as error:
            self.leave(error)
        except BaseException as error:
            log_failure("a slot", error)

    def _next(self, clock: Clock) -> Callable[[], object] | None:
        if self._posted:
            return self._posted.popleft()
        with self._guard:
            if self._delayed and self._delayed[0][0] <= clock.now():
                return heapq.heappop(self._delayed)[2]
        return None

    def _interrupt(self) -> None:
        """Raise `WorkerStopped` in the function that runs, until it returns."""
        while not self._left.wait(STOP_GRACE_S):
            with self._guard:
                if self._running is not None:
                    _raise_in(self._running, WorkerStopped)


def _raise_in(thread: int, error: type[BaseException] | None) -> None:
    """Raise an exception in another thread at its next bytecode; None: do not raise it any more."""
    state = ctypes.py_object(error) if error else None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), state)
