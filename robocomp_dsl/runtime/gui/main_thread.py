"""Runs the hooks of a component in the main thread, as events of Qt.

In: actions of the lifecycle's thread. Out: their results, or their exceptions.
"""

from __future__ import annotations

from collections.abc import Callable
from queue import SimpleQueue
from threading import Event, get_ident
from typing import Any, Generic, TypeVar

from robocomp_dsl.runtime.gui.qt import QtCore
from robocomp_dsl.runtime.gui.window_callback_group import WindowCallbackGroup

T = TypeVar("T")


class _Job(Generic[T]):
    """An action that another thread waits for."""

    def __init__(self, action: Callable[[], T]) -> None:
        self._action = action
        self._result: T
        self._error: BaseException | None = None
        self._done = Event()

    def execute(self) -> None:
        try:
            self._result = self._action()
        except BaseException as error:
            self._error = error
        finally:
            self._done.set()

    def wait(self) -> T:
        """The result. Raises what the action raised."""
        self._done.wait()
        if self._error is not None:
            raise self._error
        return self._result


class MainThread(QtCore.QObject):
    """The thread of Qt; create it there, after the application."""

    _job_posted = QtCore.Signal()

    def __init__(self, group: WindowCallbackGroup) -> None:
        super().__init__()
        self._group = group
        self._jobs: SimpleQueue[_Job[Any]] = SimpleQueue()
        self.ident = get_ident()
        self.is_running_hook = False
        self.is_blocked = False
        """A hook or a slot did not return: hooks run in the threads that call them."""
        self._job_posted.connect(self._execute, QtCore.Qt.ConnectionType.QueuedConnection)

    def run(self, action: Callable[[], T]) -> T:
        """Run `action` in the main thread, and wait for its result."""
        if self.is_blocked or get_ident() == self.ident:
            return action()
        job = _Job(action)
        self._jobs.put(job)
        self._job_posted.emit()
        return job.wait()

    def _execute(self) -> None:
        self.is_running_hook = True
        try:
            self._jobs.get().execute()
        finally:
            self.is_running_hook = False

    @QtCore.Slot()
    def release(self) -> None:
        """Release the callback group, before Qt waits for events."""
        self._group.release_when_idle()

    def eventFilter(  # noqa: N802 - the name of Qt
        self, _receiver: QtCore.QObject, _event: QtCore.QEvent
    ) -> bool:
        """Take the callback group before an event is delivered; Qt calls this for every event."""
        self._group.enter_for_event()
        return False
