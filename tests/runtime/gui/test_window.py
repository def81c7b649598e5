"""Components with a window: threads, clicks, signals, handlers, dialogs, errors and the end."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from PySide6 import QtCore, QtTest, QtWidgets

from robocomp_dsl.runtime import Component, ComponentSpec, ServedPort
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.errors import WindowError
from robocomp_dsl.runtime.gui.window import WindowComponent
from tests.runtime.gui.window_run import proxy_of, run_window
from tests.support.waiting import wait_until

COUNTS = rt.Interface("Test::Counts", rt.Operation("count", returns=rt.Int))


class CountsProxy(rt.Proxy):
    __slots__ = ()
    INTERFACE = COUNTS

    def count(self) -> int:
        return int(self._call("count"))


class Counter(WindowComponent, QtWidgets.QWidget):
    """Counts clicks; each method records its thread, and whether another one runs."""

    SPEC = ComponentSpec(
        name="counter",
        period=2,
        middleware="inproc",
        implements=(ServedPort("Counts", COUNTS, {"count": "Counts_count"}),),
        has_window=True,
    )
    counted = QtCore.Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.threads: dict[str, set[str]] = {}
        self.calls: dict[str, int] = {}
        self.is_inside = False
        self.overlaps: list[str] = []
        self.clicks = 0
        self.received: list[int] = []
        self.action: Callable[[], None] = lambda: None

    @contextmanager
    def inside(self, method: str) -> Iterator[None]:
        """Record a call of `method`."""
        if self.is_inside:
            self.overlaps.append(method)
        self.is_inside = True
        time.sleep(0.0002)  # lets other threads run, if they may
        self.threads.setdefault(method, set()).add(threading.current_thread().name)
        self.calls[method] = self.calls.get(method, 0) + 1
        yield
        self.is_inside = False

    def initialize(self) -> None:
        with self.inside("initialize"):
            self.ui.pushButton.clicked.connect(self.on_click)
            self.counted.connect(self.on_counted)
            self.ticker = QtCore.QTimer(self)
            self.ticker.timeout.connect(self.on_tick)
            self.ticker.start(1)

    def compute(self) -> None:
        with self.inside("compute"):
            self.ui.label.setText(str(self.clicks))
        self.action()

    def on_tick(self) -> None:
        with self.inside("on_tick"):
            pass

    @QtCore.Slot()
    def on_click(self) -> None:
        with self.inside("on_click"):
            self.clicks += 1

    @QtCore.Slot(int)
    def on_slider_valueChanged(self, value: int) -> None:  # noqa: N802 - connected by its name
        self.received.append(-value)

    @QtCore.Slot(int)
    def on_counted(self, number: int) -> None:
        with self.inside("on_counted"):
            self.received.append(number)

    def Counts_count(self) -> int:  # noqa: N802 - as generated
        with self.inside("Counts_count"):
            self.counted.emit(self.clicks)
        return self.clicks

    def finalize(self) -> None:
        with self.inside("finalize"):
            pass

    def click(self) -> None:
        """Click the button, as a mouse does."""
        QtTest.QTest.mouseClick(self.ui.pushButton, QtCore.Qt.MouseButton.LeftButton)


def test_window_runs_hooks_and_slots_in_main_thread() -> None:
    def click(worker: Counter, _: Runner) -> None:
        QtCore.QTimer.singleShot(0, worker, worker.click)
        wait_until(lambda: worker.clicks and worker.ui.label.text() == "1")

    worker, succeeded = run_window(Counter, click)
    main = {threading.current_thread().name}
    assert succeeded
    methods = ("initialize", "on_click", "compute", "finalize")
    assert [worker.threads[method] for method in methods] == [main] * 4


def test_window_slots_hooks_and_handlers_never_overlap() -> None:
    def call(worker: Counter, runner: Runner) -> None:
        with proxy_of(runner, CountsProxy) as counts:
            threads = [
                threading.Thread(target=lambda: [counts.count() for _ in range(100)])
                for _ in range(3)
            ]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join(60)
            wait_until(lambda: all(worker.calls.get(m, 0) > 20 for m in ("on_tick", "compute")))

    worker, _ = run_window(Counter, call)
    assert worker.calls["Counts_count"] == 300
    assert worker.overlaps == []


def test_window_queues_signals_of_handlers() -> None:
    def call(worker: Counter, runner: Runner) -> None:
        with proxy_of(runner, CountsProxy) as counts:
            counts.count()
        wait_until(lambda: worker.received)

    worker, _ = run_window(Counter, call)
    assert worker.threads["on_counted"] == {threading.current_thread().name}
    assert worker.threads["Counts_count"] != worker.threads["on_counted"]


def test_window_connects_slots_by_name() -> None:
    def slide(worker: Counter, _: Runner) -> None:
        QtCore.QTimer.singleShot(0, worker, lambda: worker.ui.slider.setValue(7))
        wait_until(lambda: worker.received)

    assert run_window(Counter, slide)[0].received == [-7]


def test_window_answers_calls_while_a_dialog_is_open() -> None:
    dialogs: list[QtWidgets.QDialog] = []
    answers: list[int] = []

    def open_dialog(worker: Counter) -> None:
        dialog = QtWidgets.QDialog(worker)
        dialogs.append(dialog)
        dialog.exec()

    def call(worker: Counter, runner: Runner) -> None:
        QtCore.QTimer.singleShot(0, worker, lambda: open_dialog(worker))
        wait_until(lambda: dialogs and dialogs[0].isVisible())
        with proxy_of(runner, CountsProxy) as counts:
            answers.append(counts.count())
        computes = worker.calls.get("compute", 0)
        wait_until(lambda: worker.calls.get("compute", 0) > computes)
        QtCore.QTimer.singleShot(0, dialogs[0], dialogs[0].accept)
        wait_until(lambda: not dialogs[0].isVisible())

    worker, succeeded = run_window(Counter, call)
    assert succeeded
    assert answers == [0]
    assert worker.overlaps == []


def test_window_logs_exception_of_a_slot_and_goes_on(caplog: pytest.LogCaptureFixture) -> None:
    def fail(worker: Counter, _: Runner) -> None:
        QtCore.QTimer.singleShot(0, worker, lambda: {}["missing"])
        wait_until(lambda: "a slot failed" in caplog.text)
        computes = worker.calls.get("compute", 0)
        wait_until(lambda: worker.calls.get("compute", 0) > computes)

    with caplog.at_level(logging.ERROR, "robocomp"):
        assert run_window(Counter, fail)[1]
    assert "a slot failed: KeyError: 'missing' (" in caplog.text
    assert f"{__file__}:" in caplog.text


def test_window_enters_emergency_if_compute_raises() -> None:
    def fail(worker: Counter, runner: Runner) -> None:
        worker.action = lambda: 1 // 0  # type: ignore[assignment,return-value]
        wait_until(lambda: runner.state is LifecycleState.EMERGENCY)
        worker.action = lambda: None
        wait_until(lambda: runner.state is LifecycleState.COMPUTE)

    assert run_window(Counter, fail)[1]


def _quit_application() -> None:
    application = QtWidgets.QApplication.instance()
    assert application
    application.quit()


@pytest.mark.parametrize(
    "end",
    [lambda w: w.close(), lambda w: w.quit(), lambda _: _quit_application()],
    ids=["window closed", "component quits", "application quits"],
)
def test_window_ends_component(end: Callable[[Counter], None]) -> None:
    def act(worker: Counter, runner: Runner) -> None:
        wait_until(lambda: worker.calls.get("compute"))
        QtCore.QTimer.singleShot(0, worker, lambda: end(worker))
        wait_until(runner.lifecycle.finalized.is_set)

    worker, succeeded = run_window(Counter, act)
    assert succeeded
    assert worker.calls["finalize"] == 1


def test_window_of_failing_initialize_ends_as_failed(caplog: pytest.LogCaptureFixture) -> None:
    class Failing(Counter):
        def initialize(self) -> None:
            self.ui.noSuchButton.setText("")

    with caplog.at_level(logging.ERROR, "robocomp"):
        _, succeeded = run_window(Failing, lambda _, runner: runner.lifecycle.finalized.wait(60))
    assert not succeeded
    assert "noSuchButton" in caplog.text


def test_window_without_qt_class_is_rejected() -> None:
    class NoWindow(WindowComponent):
        pass

    with pytest.raises(TypeError, match="NoWindow extends no window of Qt"):
        NoWindow()


def test_window_rejects_form_of_another_class(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    form = (
        '<ui version="4.0"><class>guiDlg</class><widget class="QMainWindow" name="guiDlg">'
        '<widget class="QWidget" name="centralwidget"/></widget></ui>'
    )
    (tmp_path / "mainUI.ui").write_text(form)
    monkeypatch.setitem(globals(), "__file__", str(tmp_path / "worker.py"))
    application = QtWidgets.QApplication.instance() or QtWidgets.QApplication([])
    assert application
    with pytest.raises(WindowError, match=r"mainUI\.ui: the form does not fit .* a QWidget"):
        Counter()


def test_component_is_the_base_of_every_window() -> None:
    assert issubclass(WindowComponent, Component)
