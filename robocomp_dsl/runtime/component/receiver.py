"""A queue drained by one thread at a time (leader/followers pattern).

In: a function that returns the next job. Out: every job handled, in order. When a handler waits for
a remote reply, another thread becomes the leader and continues (Schmidt et al., Pattern-Oriented
Software Architecture 2): the reply may depend on a job that is still queued.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.thread_priority import ThreadPriority
from robocomp_dsl.runtime.component.user_errors import describe_error


class QueueClosed(Exception):
    """Raised by `take` when the queue is closed."""


class LeaderFollowerQueue:
    """Threads that handle the jobs that `take` returns.

    `take` blocks, and raises `closed_error` when the queue is closed. Errors of user code are
    handled by `handle`. Anything that it or `take` raises nevertheless is a fault of the runtime:
    it goes to `fail`, which ends the component; no other thread waits for the thread that died.
    `priority` is that of the threads.
    """

    def __init__(
        self,
        name: str,
        take: Callable[[], Any],
        handle: Callable[[Any], None],
        execution: CallbackGroup,
        fail: Callable[[str], None],
        closed_error: type[Exception] = QueueClosed,
        priority: ThreadPriority | None = None,
    ) -> None:
        self._closed_error = closed_error
        self._priority = priority
        self._name = name
        self._take = take
        self._handle = handle
        self._execution = execution
        self._fail = fail
        self._leader_lock = threading.Lock()
        self._lock = threading.Lock()
        self._leader = 0
        self._waiting_followers = 0
        self._closed = False
        self._threads: list[threading.Thread] = []
        self._start()

    def _start(self) -> None:
        thread = threading.Thread(target=self._run, name=self._name, daemon=True)
        self._threads.append(thread)
        thread.start()

    def _run(self) -> None:
        me = threading.get_ident()
        if self._priority:
            self._priority.start_thread()
        self._execution.on_release(self._hand_off)
        try:
            self._handle_jobs(me)
        except BaseException as error:
            self._closed = True
            if self._leader == me:
                self._leader = 0
                self._leader_lock.release()
            self._fail(f"the thread {self._name} died: {describe_error(error)}")
        self._execution.on_release(None)

    def _handle_jobs(self, me: int) -> None:
        handle, take = self._handle, self._take
        while self._leader == me or self._become_leader(me):
            try:
                job = take()
            except self._closed_error:
                self._closed = True
                self._leader = 0
                self._leader_lock.release()
            else:
                handle(job)
                # Dropped before the next wait; otherwise a query would stay open until then.
                del job

    def _become_leader(self, me: int) -> bool:
        """Become the leader; False if the queue is closed."""
        with self._lock:
            self._waiting_followers += 1
        self._leader_lock.acquire()
        with self._lock:
            self._waiting_followers -= 1
        if self._closed:
            self._leader_lock.release()
            return False
        self._leader = me
        return True

    def _hand_off(self) -> None:
        """Make another thread the leader, because this thread waits; start one if none is free."""
        if self._leader != threading.get_ident():
            return
        self._leader = 0
        with self._lock:
            if not self._waiting_followers and not self._closed:
                self._start()
        self._leader_lock.release()

    @property
    def threads(self) -> list[threading.Thread]:
        """All threads that were started."""
        return list(self._threads)

    @property
    def is_running(self) -> bool:
        """Whether a thread has not ended."""
        return any(thread.is_alive() for thread in self._threads)

    def join(self, timeout: float) -> bool:
        """Wait for the threads to exit (`take` must raise); returns whether they did."""
        me = threading.current_thread()
        for thread in self._threads:
            if thread is not me:
                thread.join(timeout)
        return not any(t.is_alive() for t in self._threads if t is not me)
