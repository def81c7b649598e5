"""Calls the hooks of a component for events of its connections.

In: events from any thread. Out: the hooks `deadline_missed`, `publisher_lost` and
`publisher_alive` of the user's class, in the callback group of the component, in order.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any, TypeAlias

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.receiver import LeaderFollowerQueue, QueueClosed
from robocomp_dsl.runtime.component.user_errors import log_failure

Hook: TypeAlias = Callable[..., None]
MAX_PENDING = 1000
"""Events that wait while a callback of the component hangs; further events are not delivered."""


class ConnectionEvents:
    """The events of one component. `call_hook(name, *arguments)` calls a hook of the user."""

    def __init__(
        self,
        component: str,
        group: CallbackGroup,
        call_hook: Callable[..., None] | None,
        fail: Callable[[str], None],
    ) -> None:
        self._component = component
        self._group = group
        self._call_hook = call_hook
        self._fail = fail
        self._events: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._receiver: LeaderFollowerQueue | None = None
        self._lock = threading.Lock()
        self._closed = False

    def notify(self, hook: str, port: str, *arguments: Any) -> None:
        """Call a hook of the user's class; any thread."""
        call_hook = self._call_hook
        if call_hook is None or self._events.qsize() > MAX_PENDING:
            return

        def call() -> None:
            with self._group:
                if not self._closed:
                    call_hook(hook, port, *arguments)

        self.run(call, f"{hook}({port})")

    def run(self, job: Callable[[], None], name: str) -> None:
        """Run a job in the thread of the events; it takes the callback group itself."""

        def guarded() -> None:
            try:
                job()
            except Exception as error:
                log_failure(name, error)

        with self._lock:
            if self._closed:
                return
            if self._receiver is None:
                self._receiver = LeaderFollowerQueue(
                    f"{self._component}.connections",
                    self._take,
                    lambda event: event(),
                    self._group,
                    self._fail,
                )
            self._events.put(guarded)

    def _take(self) -> Callable[[], None]:
        event = self._events.get()
        if event is None or self._closed:
            self._events.put(None)  # for the other threads
            raise QueueClosed
        return event

    def close(self) -> None:
        """Call no further hook; a running hook may finish."""
        with self._lock:
            self._closed = True
            self._events.put(None)
            receiver = self._receiver
        if receiver:
            receiver.join(0.5)
