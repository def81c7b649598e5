"""The watchdog of a component: what hangs, what does not, and how the component then ends."""

from __future__ import annotations

import bdb
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Self

import pytest

from robocomp_dsl.runtime.component import debugger
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.component.watchdog import CallbackWatchdog

LIMIT_S = 2.0


def ignore(*_: object) -> None:
    pass


def unstarted(group: CallbackGroup) -> CallbackWatchdog:
    """A watchdog whose `check` the test calls itself."""
    return CallbackWatchdog(LIMIT_S, group, lambda _thread: "compute", ignore, ignore)


class Callback:
    """A thread that holds the callback group while `action` runs."""

    def __init__(self, group: CallbackGroup, action: Callable[[], object]) -> None:
        self.inside = threading.Event()
        self._group = group
        self._action = action
        self._thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        with self._group:
            self.inside.set()
            self._action()

    def __enter__(self) -> Self:
        self._thread.start()
        assert self.inside.wait(30)
        return self

    def __exit__(self, *_: object) -> None:
        self._thread.join(30)


@pytest.fixture
def release() -> Iterator[threading.Event]:
    event = threading.Event()
    yield event
    event.set()


def test_watchdog_reports_callback_over_the_limit(release: threading.Event) -> None:
    group = CallbackGroup()
    watchdog = unstarted(group)

    def blocked() -> None:
        release.wait(60)

    with Callback(group, blocked):
        assert watchdog.check(0.0) is None
        assert watchdog.check(LIMIT_S - 0.1) is None
        report = watchdog.check(0.1)
        release.set()
    assert report
    line = blocked.__code__.co_firstlineno + 1
    assert report.location == f"{__file__}:{line}"
    assert any("in blocked" in frame for frame in report.stack)
    assert report.summary() == f"compute has hung for 2.0 s at {__file__}:{line}"
    assert HangReport.from_json(report.to_json()) == report


def test_watchdog_counts_each_callback_from_its_start() -> None:
    group = CallbackGroup()
    watchdog = unstarted(group)
    for _ in range(3):
        with group:
            assert watchdog.check(LIMIT_S - 0.1) is None
            assert watchdog.check(LIMIT_S - 0.1) is None


def test_watchdog_ignores_waiting_for_reply_but_adds_up_own_time() -> None:
    group = CallbackGroup()
    watchdog = unstarted(group)
    with group:
        watchdog.check(0.0)
        assert watchdog.check(LIMIT_S - 0.1) is None
        began = group.pause()
        assert began
        assert watchdog.check(100 * LIMIT_S) is None
        group.resume(began)
        assert watchdog.check(0.2)


def test_watchdog_ignores_waiting_for_the_callback_group(release: threading.Event) -> None:
    group = CallbackGroup()
    watchdog = unstarted(group)
    waiting = Callback(group, ignore)
    with group:
        began = group.holders[threading.get_ident()]
        waiting._thread.start()
        watchdog.check(0.0)
        report = watchdog.check(LIMIT_S)
        assert list(group.holders.values()) == [began]
    waiting._thread.join(30)
    assert report
    assert "test_watchdog_ignores_waiting_for_the_callback_group" in "".join(report.stack)


def test_watchdog_reports_thread_that_died_in_the_group() -> None:
    group = CallbackGroup()
    thread = threading.Thread(target=group.enter)
    thread.start()
    thread.join(30)
    watchdog = unstarted(group)
    watchdog.check(0.0)
    report = watchdog.check(LIMIT_S)
    assert report
    assert report.stack == ("the thread has ended",)


@pytest.mark.parametrize("traced", [False, True])
def test_watchdog_is_off_while_a_debugger_traces(traced: bool) -> None:
    group = CallbackGroup()
    watchdog = unstarted(group)
    tracer = bdb.Bdb()
    frame = sys._getframe()
    with group:
        frame.f_trace = tracer.trace_dispatch if traced else None
        try:
            watchdog.check(0.0)
            report = watchdog.check(LIMIT_S)
        finally:
            frame.f_trace = None
    assert (report is None) == traced


def test_debugger_tracer_of_reads_proc_status(tmp_path: Path) -> None:
    path = tmp_path / "status"
    path.write_text("Name:\tpython\nTracerPid:\t4711\nUid:\t0\n")
    assert debugger.tracer_of(path) == 4711
    assert debugger.tracer_of(Path("/proc/self/status")) == 0
    assert debugger.tracer_of(tmp_path / "absent") == 0
