"""Detects a callback of a component that does not return.

In: the callback group, whose `holders` say which thread runs a callback and since when; that is the
heartbeat of `compute` and of the handlers, and costs them nothing more. Out: one `HangReport` with
the Python stack of the thread. Only time in which a thread runs user code counts: a thread that
waits for a remote reply (a call has a time-out of its own), for simulated time or for its turn does
not hang.
"""

from __future__ import annotations

import faulthandler
import sys
import threading
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from types import FrameType

from robocomp_dsl.runtime.component import debugger
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.component.user_errors import is_library_code, user_location

CHECKS_PER_TIMEOUT = 8
MIN_INTERVAL_S = 0.02
MAX_INTERVAL_S = 1.0


class CallbackWatchdog:
    """Checks the callbacks of one component in a thread, and calls `on_hang` at the first hang.

    `activity_of` describes what a thread (by its identifier) does; "" exempts it. `on_beat` is
    called at every check with the time in s within which the next call follows, unless the process
    hangs; 0: none follows.
    """

    def __init__(
        self,
        timeout_s: float,
        group: CallbackGroup,
        activity_of: Callable[[int], str],
        on_hang: Callable[[HangReport], None],
        on_beat: Callable[[float], None],
    ) -> None:
        self._timeout_s = timeout_s
        self._group = group
        self._activity_of = activity_of
        self._on_hang = on_hang
        self._on_beat = on_beat
        self._interval_s = min(max(timeout_s / CHECKS_PER_TIMEOUT, MIN_INTERVAL_S), MAX_INTERVAL_S)
        self._running_s: dict[int, tuple[int, float]] = {}
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run, name="watchdog", daemon=True)
        # A debugger that stops all threads at a breakpoint leaves this one running.
        self._thread.pydev_do_not_trace = True  # type: ignore[attr-defined]
        self._thread.is_pydev_daemon_thread = True  # type: ignore[attr-defined]

    def start(self) -> None:
        """Start checking."""
        self._thread.start()

    def stop(self) -> None:
        """Stop checking; hooks that end the component have time limits of their own."""
        self._stopped.set()

    def _run(self) -> None:
        report, before = None, time.monotonic()
        while report is None and not self._stopped.wait(self._interval_s):
            self._schedule_dump()
            self._on_beat(self._timeout_s)
            now = time.monotonic()
            # While the whole process was stopped, no callback was running.
            report = self.check(min(now - before, 2 * self._interval_s))
            before = now
        faulthandler.cancel_dump_traceback_later()
        self._on_beat(0.0)
        if report:
            self._on_hang(report)

    def _schedule_dump(self) -> None:
        """Write all stacks to standard error if this thread cannot run again in time.

        A callback in a C extension may hold the interpreter lock; no Python code runs then.
        """
        with suppress(AttributeError, OSError, ValueError):  # no usable standard error
            faulthandler.dump_traceback_later(
                self._timeout_s + self._interval_s, file=sys.__stderr__ or sys.stderr
            )

    def check(self, elapsed_s: float) -> HangReport | None:
        """Add `elapsed_s` to the callbacks that run; returns a report if one exceeds the limit."""
        frames = sys._current_frames()
        holders = dict(self._group.holders)
        for thread, began in holders.items():
            known_began, seconds = self._running_s.get(thread, (0, 0.0))
            seconds = seconds + elapsed_s if known_began == began else 0.0
            self._running_s[thread] = began, seconds
            if seconds < self._timeout_s or not (activity := self._activity_of(thread)):
                continue
            frame = frames.get(thread)
            if debugger.is_attached(frame):
                self._running_s[thread] = began, 0.0
            else:
                return _report(activity, seconds, frame)
        alive = frames.keys() | holders.keys()
        self._running_s = {t: known for t, known in self._running_s.items() if t in alive}
        return None


def _report(activity: str, seconds: float, frame: FrameType | None) -> HangReport:
    """The report of a hang in `frame`; None: the thread ended in the callback group."""
    stack = traceback.extract_stack(frame) if frame else traceback.StackSummary()
    first = next((i for i, call in enumerate(stack) if not is_library_code(call.filename)), 0)
    stack = traceback.StackSummary.from_list(stack[first:])
    lines = "".join(stack.format()).splitlines() or ["the thread has ended"]
    return HangReport(time.time(), activity, seconds, user_location(stack), tuple(lines))
