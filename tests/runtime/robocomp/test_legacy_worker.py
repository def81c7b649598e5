"""Workers of RoboComp behave as with Qt and Ice: timers, signals, machines, handlers."""

from __future__ import annotations

import threading
from collections.abc import Callable

from robocomp_dsl.runtime.robocomp.qt import QApplication, QtCore, QTimer, Signal, qApp
from robocomp_dsl.runtime.robocomp.worker import LegacyWorker
from tests.runtime.robocomp.conftest import DEADLINE_S, RunningWorker
from tests.support.waiting import wait_until

Run = Callable[..., RunningWorker]


def test_default_machine_enters_compute_each_period(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object, startup_check: bool = False) -> None:
            super().__init__(proxy_map)
            self.Period = 5
            self.timer.start(self.Period)
            self.defaultMachine.start()
            self.destroyed.connect(self.t_compute_to_finalize)

        def setParams(self, params: object) -> bool:
            calls.append("setParams")
            return True

        def compute(self) -> None:
            calls.append("compute")

        def sm_initialize(self) -> None:
            calls.append("sm_initialize")
            self.t_initialize_to_compute.emit()

        def sm_compute(self) -> None:
            self.compute()
            if len(calls) == 6:
                self.t_compute_to_finalize.emit()

        def sm_finalize(self) -> None:
            calls.append("sm_finalize")

    running = run_worker(SpecificWorker, period_ms=0)
    wait_until(lambda: "sm_finalize" in calls)
    assert calls == ["setParams", "sm_initialize", *["compute"] * 4, "sm_finalize"]
    assert running.life.state.value == "compute"
    assert running.life.period_ms == 5


def test_default_machine_without_timer_enters_compute_once(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.defaultMachine.start()
            QTimer.singleShot(60, lambda: calls.append("later"))

        def sm_initialize(self) -> None:
            self.t_initialize_to_compute.emit()

        def sm_compute(self) -> None:
            calls.append("sm_compute")

    run_worker(SpecificWorker, period_ms=5)
    wait_until(lambda: "later" in calls)
    assert calls == ["sm_compute", "later"]


def test_compute_timer_stops_and_restarts(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.timer.timeout.connect(self.compute)
            self.timer.timeout.connect(self.draw)
            self.timer.start(5)

        def compute(self) -> None:
            calls.append("compute")
            if len(calls) == 3:
                self.timer.stop()
                QTimer.singleShot(50, self.again)

        def draw(self) -> None:
            calls.append("draw")

        def again(self) -> None:
            calls.append("again")
            self.timer.setInterval(7)
            self.timer.start()

    running = run_worker(SpecificWorker)
    wait_until(lambda: len(calls) > 6)
    assert calls[:7] == ["compute", "draw", "compute", "draw", "again", "compute", "draw"]
    assert running.life.period_ms == 7
    assert running.worker.timer.isActive()


def test_compute_timer_without_slots_calls_nothing(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.timer.start(5)
            QTimer.singleShot(50, lambda: calls.append("later"))

        def compute(self) -> None:
            calls.append("compute")

    run_worker(SpecificWorker)
    wait_until(lambda: calls)
    assert calls == ["later"]


def test_own_timers_fire_until_stopped(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.blink, self.single = QtCore.QTimer(self), QTimer()
            self.blink.timeout.connect(self.on_blink)
            self.blink.start(5)
            self.single.setSingleShot(True)
            self.single.timeout.connect(lambda: calls.append("single"))
            self.single.start(1)

        def on_blink(self) -> None:
            calls.append("blink")
            if calls.count("blink") == 3:
                self.blink.stop()
                QTimer.singleShot(50, lambda: calls.append("end"))
                raise ValueError("a slot may fail")

    running = run_worker(SpecificWorker)
    wait_until(lambda: "end" in calls)
    assert sorted(calls) == ["blink", "blink", "blink", "end", "single"]
    assert calls[-1] == "end"
    assert not running.worker.single.isActive()


def test_single_shot_waits_for_its_delay(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            QTimer.singleShot(30, lambda: calls.append("late"))
            QTimer.singleShot(0, lambda: calls.append("soon"))
            calls.append("init")

    run_worker(SpecificWorker)
    wait_until(lambda: len(calls) == 3)
    assert calls == ["init", "soon", "late"]


def test_endless_compute_lets_handlers_run_and_stops(run_worker: Run) -> None:
    entered = threading.Event()

    class SpecificWorker(LegacyWorker):
        speed = 0

        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.timer.timeout.connect(self.compute)
            self.timer.start(5)

        def compute(self) -> None:
            while True:
                entered.set()
                with QtCore.QMutexLocker(self.mutex):
                    self.speed += 0

        def Base_setSpeed(self, speed: int) -> int:
            self.speed = speed
            return self.speed

    running = run_worker(SpecificWorker)
    assert entered.wait(DEADLINE_S)
    assert running.call(running.worker.Base_setSpeed, 5) == 5
    assert running.stop()


def test_signal_of_handler_calls_slot_in_event_loop(run_worker: Run) -> None:
    calls: list[object] = []

    class SpecificWorker(LegacyWorker):
        moved = Signal(int, str)

        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.moved.connect(self.on_moved)

        def on_moved(self, distance: int) -> None:
            calls.extend([distance, self._loop.is_here, threading.current_thread().name])

    running = run_worker(SpecificWorker, period_ms=0)
    wait_until(lambda: running.life.state.value == "compute")
    running.call(running.worker.moved.emit, 7, "left")
    wait_until(lambda: len(calls) == 3)
    assert calls == [7, True, "old.events"]
    running.worker.moved.disconnect(running.worker.on_moved)
    assert not running.worker.moved.is_connected


def test_application_quit_stops_component(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.destroyed.connect(lambda: calls.append("destroyed"))
            QTimer.singleShot(1, QApplication.instance().quit)

    running = run_worker(SpecificWorker)
    wait_until(lambda: calls)
    assert running.stop()
    assert calls == ["destroyed"]


def test_set_period_starts_timer(run_worker: Run) -> None:
    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            self.count = 0
            self.timer.timeout.connect(self.compute)
            assert self.Period == 30
            self.setPeriod(3)

        def compute(self) -> None:
            self.count += 1

    running = run_worker(SpecificWorker, period_ms=0)
    wait_until(lambda: running.worker.count > 2)
    assert (running.worker.Period, running.life.period_ms) == (3, 3)


def test_own_initialize_is_called_by_old_code_only(run_worker: Run) -> None:
    calls: list[object] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object, configData: object) -> None:
            super().__init__(proxy_map, configData)
            calls.append(self.initialize())
            calls.append(self.configData)

        def initialize(self) -> bool:  # type: ignore[override]
            return True

    running = run_worker(SpecificWorker)
    wait_until(lambda: running.life.state.value == "compute")
    assert calls == [True, {}]


def test_worker_without_init_has_hook(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def initialize(self) -> None:
            calls.append("initialize")

    run_worker(SpecificWorker)
    wait_until(lambda: calls)
    assert calls == ["initialize"]


def test_application_emits_about_to_quit(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def __init__(self, proxy_map: object) -> None:
            super().__init__(proxy_map)
            QApplication.instance().aboutToQuit.connect(lambda: calls.append("saved"))
            QTimer.singleShot(1, qApp.quit)

    running = run_worker(SpecificWorker)
    wait_until(lambda: calls)
    assert running.stop()


def test_process_events_calls_due_slots(run_worker: Run) -> None:
    calls: list[str] = []

    class SpecificWorker(LegacyWorker):
        def compute(self) -> None:
            QTimer.singleShot(0, lambda: calls.append("slot"))
            while not calls:
                QApplication.processEvents()
            calls.append("compute")
            self.quit()

    running = run_worker(SpecificWorker)
    wait_until(lambda: "compute" in calls)
    assert running.stop()
    assert calls[:2] == ["slot", "compute"]
