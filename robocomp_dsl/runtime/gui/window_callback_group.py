"""Mutual exclusion of the handlers, the hooks and the slots of a component with a window.

In: the events of Qt. Out: the main thread holds a slot of the callback group while it delivers
events, and none while it waits for events. Timers, clicks, painting and hooks are events, so that
none of them runs at the same time as a handler. A window that a slot opens and waits for (`exec`)
waits for events, too: handlers run meanwhile.
"""

from __future__ import annotations

from threading import get_ident

from robocomp_dsl.runtime.component.callback_group import CallbackGroup


class WindowCallbackGroup(CallbackGroup):
    """A callback group that the main thread enters with its first event, and then again.

    Create it in the main thread. Only the outermost `leave` of that thread could release its slot,
    and does not: `release_when_idle` does.
    """

    __slots__ = ("_main_thread",)

    def __init__(self, threads: int = 1) -> None:
        super().__init__(threads)
        self._main_thread = get_ident()

    def enter(self, timeout: float | None = None) -> bool:
        """See `CallbackGroup.enter`; the main thread may enter again."""
        if self._main_thread in self.holders and get_ident() == self._main_thread:
            return True
        return super().enter(timeout)

    def leave(self) -> None:
        """Release the slot; the main thread keeps its slot until it waits for events."""
        if get_ident() != self._main_thread:
            super().leave()

    def enter_for_event(self) -> None:
        """Take a slot, as the main thread delivers an event."""
        if self._main_thread not in self.holders and get_ident() == self._main_thread:
            super().enter()

    def release_when_idle(self) -> None:
        """Release the slot of the main thread, which now waits for events."""
        if self._main_thread in self.holders:
            super().leave()
