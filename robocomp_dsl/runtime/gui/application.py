"""The program of a component with a window: the event loop of Qt, from the start to the end.

In: a component. Out: its window, until the last window is closed, the component stops, or a signal
arrives. The display that cannot be used is an error that says what to do; without any display the
window is rendered offscreen.
"""

from __future__ import annotations

import logging
import os
import sys
import threading
from collections.abc import Callable
from threading import Thread
from types import TracebackType
from typing import Protocol, TypeVar

from robocomp_dsl.runtime.component.process_exit import exit_now
from robocomp_dsl.runtime.component.user_errors import log_failure
from robocomp_dsl.runtime.gui.main_thread import MainThread
from robocomp_dsl.runtime.gui.qt import QtCore, QtWidgets
from robocomp_dsl.runtime.gui.window_callback_group import WindowCallbackGroup

T = TypeVar("T")
PLATFORM = "QT_QPA_PLATFORM"
DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
log = logging.getLogger("robocomp")


class StoppableRunner(Protocol):
    """The part of `Runner` that the application uses."""

    abandoned: bool

    def stop(self) -> None:
        """Request a stop."""

    def wait(self) -> bool:
        """Wait for the end; returns whether it stopped normally."""


class WindowApplication:
    """Qt in the main thread of a component. Create it there, before the component."""

    def __init__(self, name: str, threads: int) -> None:
        _choose_platform()
        QtCore.qInstallMessageHandler(_log_message)
        existing = QtWidgets.QApplication.instance()
        self._application = existing or QtWidgets.QApplication([name])
        self._application.setApplicationName(name)
        self.callback_group = WindowCallbackGroup(threads)
        self._main_thread = MainThread(self.callback_group)
        self._application.installEventFilter(self._main_thread)
        self._dispatcher = QtCore.QAbstractEventDispatcher.instance()
        self._dispatcher.aboutToBlock.connect(self._main_thread.release)
        sys.excepthook = _log_exception
        self._succeeded = False

    def call(self, action: Callable[[], T]) -> T:
        """Run a hook in the main thread; returns its result, or raises its exception."""
        return self._main_thread.run(action)

    def activity_of(self, thread: int) -> str:
        """What `thread` does: `hook` or `slot`; empty for another thread than the main thread."""
        if thread != self._main_thread.ident:
            return ""
        return "hook" if self._main_thread.is_running_hook else "slot"

    def abandon(self) -> None:
        """The main thread hangs: run further hooks in the threads that call them."""
        self._main_thread.is_blocked = True

    def run(self, runner: StoppableRunner) -> bool:
        """Run the event loop until the component has ended; returns whether it stopped normally."""

        def wait() -> None:
            self._succeeded = runner.wait()
            if runner.abandoned:
                exit_now(1)  # a hook or a slot does not return
            QtCore.QMetaObject.invokeMethod(
                self._application, "quit", QtCore.Qt.ConnectionType.QueuedConnection
            )

        def stop() -> None:
            # The last window was closed, or the user's code called `quit`. Hooks need the loop.
            while waiting.is_alive():
                runner.stop()
                self._application.processEvents()
                self.callback_group.release_when_idle()
                waiting.join(_POLL_S)

        waiting = Thread(target=wait, name="stop", daemon=True)
        waiting.start()
        # A slot may call `sys.exit`; the interpreter then waits for threads before `atexit` runs.
        threading._register_atexit(stop)  # type: ignore[attr-defined]
        self._application.exec()
        stop()
        self._application.processEvents()  # of `wait`, if the loop had ended before
        self._application.removeEventFilter(self._main_thread)
        self._dispatcher.aboutToBlock.disconnect(self._main_thread.release)
        QtCore.qInstallMessageHandler(None)
        return self._succeeded


def _choose_platform() -> None:
    """Render offscreen if there is no display, and nothing else was chosen."""
    if os.environ.get(PLATFORM) or any(os.environ.get(name) for name in DISPLAYS):
        return
    log.warning(
        "the window is not shown: there is no display, as neither %s is set", " nor ".join(DISPLAYS)
    )
    os.environ[PLATFORM] = "offscreen"


_POLL_S = 0.005
_NO_DEFECT = "This plugin does not support "
"""The beginning of what Qt says about every window that is rendered offscreen."""
_LEVELS = {
    QtCore.QtMsgType.QtDebugMsg: logging.DEBUG,
    QtCore.QtMsgType.QtInfoMsg: logging.INFO,
    QtCore.QtMsgType.QtWarningMsg: logging.WARNING,
    QtCore.QtMsgType.QtCriticalMsg: logging.ERROR,
    QtCore.QtMsgType.QtFatalMsg: logging.ERROR,
}


def _log_message(
    kind: QtCore.QtMsgType, _context: QtCore.QMessageLogContext, message: str | None
) -> None:
    """Log a message of Qt; a fatal one, after which Qt aborts the process, ends the component."""
    if kind is QtCore.QtMsgType.QtFatalMsg:
        first = (message or "").partition("\n")[0]
        log.error("Qt cannot open the window: %s", first)
        log.error(
            "%s is `%s`, DISPLAY is `%s`: start the component in a graphical session, or set"
            " %s=offscreen to run it without one; Qt needs libxcb-cursor0 of the system for X",
            PLATFORM,
            os.environ.get(PLATFORM, ""),
            os.environ.get("DISPLAY", ""),
            PLATFORM,
        )
        exit_now(1)
    level = logging.DEBUG if (message or "").startswith(_NO_DEFECT) else _LEVELS[kind]
    log.log(level, "Qt: %s", message)


def _log_exception(
    _kind: type[BaseException], error: BaseException, trace: TracebackType | None
) -> None:
    """Log an exception of a slot, which Qt has caught; the component goes on."""
    log_failure("a slot", error.with_traceback(trace))
