"""The thread in which the hooks of a component run.

Usually that of its lifecycle; that of Qt for a component with a window.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeVar

from robocomp_dsl.runtime.component.callback_group import CallbackGroup

T = TypeVar("T")


class HookThread(Protocol):
    """Calls hooks; `callback_group` excludes them from handlers."""

    @property
    def callback_group(self) -> CallbackGroup:
        """The callback group of the component."""

    def call(self, hook: Callable[[], T]) -> T:
        """Call a hook in the thread; returns its result, or raises its exception."""

    def activity_of(self, thread: int) -> str:
        """What `thread` does: `hook`, `slot` of a window, or nothing that is known here."""

    def abandon(self) -> None:
        """Call further hooks in the threads that request it, because this one hangs."""


class LifecycleThread:
    """The hooks run in the thread of the lifecycle, which calls them."""

    def __init__(self, callback_group: CallbackGroup) -> None:
        self.callback_group = callback_group

    def call(self, hook: Callable[[], T]) -> T:
        """Call a hook."""
        return hook()

    def activity_of(self, _thread: int) -> str:
        """Nothing: the runner knows what the thread of the lifecycle does."""
        return ""

    def abandon(self) -> None:
        """Nothing: another thread may call hooks."""
