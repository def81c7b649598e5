"""Which callbacks the watchdog of a component checks, how long they may run, and their names."""

from __future__ import annotations

import math
import threading

from robocomp_dsl.runtime.component.hook_thread import HookThread
from robocomp_dsl.runtime.component.lifecycle import Lifecycle, LifecycleState

PING_MARGIN = 0.75
"""A hang is found after this share of the interval in which the supervisor expects a ping."""
_EXEMPT = (LifecycleState.INITIALIZE, LifecycleState.FINALIZE)


def watchdog_limit(limit_s: float, ping_interval_s: float) -> float:
    """The time in s that a callback may take; 0.0: no limit.

    `limit_s` is that of the component; a supervisor that expects pings more often sets a lower one.
    """
    if not ping_interval_s:
        return limit_s
    return min(limit_s or math.inf, ping_interval_s * PING_MARGIN)


class WatchedCallbacks:
    """Describes the callbacks of the component `name`; its hooks run in `thread`."""

    def __init__(
        self, name: str, lifecycle: Lifecycle, hook_thread: HookThread, thread: threading.Thread
    ) -> None:
        self._name = name
        self._lifecycle = lifecycle
        self._hook_thread = hook_thread
        self._thread = thread

    def activity_of(self, thread: int) -> str:
        """What a thread in the callback group does; "" for a hook that is exempt."""
        activity = self._hook_thread.activity_of(thread)
        if activity == "slot":
            return "a slot of the window"
        if activity or thread == self._thread.ident:
            state = self._lifecycle.state
            return "" if state in _EXEMPT else state.value
        name = next((t.name for t in threading.enumerate() if t.ident == thread), "")
        own, _, port = name.rpartition(".")
        is_handler = own == self._name
        return f"a handler of {port}" if is_handler else f"a call in thread {name or thread}"
