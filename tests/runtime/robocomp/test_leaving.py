"""`sys.exit` of a worker ends the component with its code; `__del__` runs once, at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import SimpleNamespace

import pytest

from robocomp_dsl.runtime.robocomp.leaving import exit_code_of
from robocomp_dsl.runtime.robocomp.qt import QtCore
from robocomp_dsl.runtime.robocomp.worker import LegacyWorker
from tests.runtime.robocomp.conftest import RunningWorker
from tests.support.waiting import wait_until

Run = Callable[..., RunningWorker]


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (SystemExit(), 0),
        (SystemExit(0), 0),
        (SystemExit(3), 3),
        (SystemExit(-1), 255),
        (SystemExit("no camera"), 1),
    ],
)
def test_exit_code_of_is_that_of_python(error: SystemExit, code: int) -> None:
    assert exit_code_of(error) == code


def test_leave_from_compute_ends_component(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.timer.timeout.connect(self.compute)
            self.timer.start(5)

        def compute(self) -> None:
            calls.append("compute")
            sys.exit(3)

    running = run_worker(SpecificWorker)
    wait_until(running.life.finalized.is_set)
    assert running.life.exit_code == 3
    assert calls == ["compute"]


def test_leave_from_slot_ends_component(run_worker: Run) -> None:
    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.second = QtCore.QTimer(self)
            self.second.timeout.connect(self.look)
            self.second.start(5)

        def look(self) -> None:
            sys.exit()

    running = run_worker(SpecificWorker)
    wait_until(running.life.finalized.is_set)
    assert running.life.exit_code == 0


def test_leave_from_setParams_ends_component_before_compute(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.timer.timeout.connect(self.compute)
            self.timer.start(1)

        def setParams(self, params: object) -> None:
            sys.exit(-1)

        def compute(self) -> None:
            calls.append("compute")

    running = run_worker(SpecificWorker)
    wait_until(running.life.finalized.is_set)
    assert (running.life.exit_code, calls) == (255, [])


def test_leave_from_handler_ends_component(run_worker: Run) -> None:
    port = SimpleNamespace(methods={"halt": "Robot_halt", "look": "Robot_look"})

    class SpecificWorker(LegacyWorker):
        SPEC = SimpleNamespace(implements=(port,), subscribes=())  # type: ignore[assignment]

        def Robot_halt(self, code: int) -> None:
            sys.exit(code)

    running = run_worker(SpecificWorker)
    wait_until(lambda: running.life.state.value == "compute")
    with pytest.raises(SystemExit):
        running.call(running.worker.Robot_halt, 4)
    wait_until(running.life.finalized.is_set)
    assert running.life.exit_code == 4


def test_leave_while_initialize_waits_is_no_failure(
    run_worker: Run, caplog: pytest.LogCaptureFixture
) -> None:
    waiting: list[int] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            while True:
                waiting.append(1)
                QtCore.QCoreApplication.instance()

    running = run_worker(SpecificWorker)
    wait_until(lambda: bool(waiting))
    running.life.stop()
    wait_until(running.life.finalized.is_set)
    assert running.life.exit_code == 0
    assert "failed" not in caplog.text


def test_delete_runs_once_at_the_end(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.timer.timeout.connect(self.compute)
            self.timer.start(5)

        def compute(self) -> None:
            self.quit()

        def __del__(self) -> None:
            calls.append("closed")

    running = run_worker(SpecificWorker)
    wait_until(running.life.finalized.is_set)
    assert calls == ["closed"]
    running.worker.__del__()
    assert calls == ["closed"]
