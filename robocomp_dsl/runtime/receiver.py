"""A queue drained by one thread at a time, even when a handler waits in the middle of it.

In: a function that gives the next job. Out: every job handled, in order. When a handler waits for a
remote answer, another thread takes over the draining ("leader and followers"; Schmidt et al.,
Pattern-Oriented Software Architecture 2): the answer may depend on a job that is still queued.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.execution import Execution


class Closed(Exception):
    """Raised by `take` when there will be no more jobs."""


class Receiver:
    """Threads that handle what `take` gives; `take` blocks, and raises `over` at the end.

    `handle` deals with its own failures.
    """

    def __init__(
        self,
        name: str,
        take: Callable[[], Any],
        handle: Callable[[Any], None],
        execution: Execution,
        over: type[Exception] = Closed,
    ) -> None:
        self._ends = over
        self._name = name
        self._take = take
        self._handle = handle
        self._execution = execution
        self._baton = threading.Lock()
        self._guard = threading.Lock()
        self._leader = 0
        self._spare = 0
        self._over = False
        self._threads: list[threading.Thread] = []
        self._start()

    def _start(self) -> None:
        thread = threading.Thread(target=self._run, name=self._name, daemon=True)
        self._threads.append(thread)
        thread.start()

    def _run(self) -> None:
        me = threading.get_ident()
        self._execution.on_pause(self._hand_over)
        handle, take = self._handle, self._take
        while self._leader == me or self._lead(me):
            try:
                job = take()
            except self._ends:
                self._over = True
                self._leader = 0
                self._baton.release()
            else:
                handle(job)
                # Gone before the next wait, or a query would be held open until then.
                del job
        self._execution.on_pause(None)

    def _lead(self, me: int) -> bool:
        """Become the leader; False when there is nothing left to lead."""
        with self._guard:
            self._spare += 1
        self._baton.acquire()
        with self._guard:
            self._spare -= 1
        if self._over:
            self._baton.release()
            return False
        self._leader = me
        return True

    def _hand_over(self) -> None:
        """The leader is about to wait: let another one lead, a new one if none is free."""
        if self._leader != threading.get_ident():
            return
        self._leader = 0
        with self._guard:
            if not self._spare and not self._over:
                self._start()
        self._baton.release()

    def join(self, timeout: float) -> bool:
        """Wait for the threads to end, which needs `take` to raise; tells whether they did."""
        me = threading.current_thread()
        for thread in self._threads:
            if thread is not me:
                thread.join(timeout)
        return not any(t.is_alive() for t in self._threads if t is not me)
