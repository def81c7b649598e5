"""Components, and programs, whose callbacks hang or overrun their period."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import threading
import uuid

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.clock import WakeEvent
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.parameters import Parameter, Parameters
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from tests.support.waiting import wait_until

LIMIT_S = 2.0


def ignore(*_: object) -> None:
    pass


class ArmParams(Parameters):
    SCHEMA = (Parameter("rate", "float", default=1.0, live=True),)
    rate: float


class Hanging(Component):
    """Waits in the method named `hangs_in`, until `release`."""

    SPEC = ComponentSpec(
        name="hanging", period=1, middleware="inproc", parameters=ArmParams, watchdog=0.1
    )
    hangs_in = ""

    def __init__(self) -> None:
        self.release = threading.Event()
        self.finalized = threading.Event()
        self.computes = 0

    def _enter(self, method: str) -> None:
        if method == self.hangs_in:
            self.release.wait(60)

    def initialize(self) -> None:
        self._enter("initialize")

    def compute(self) -> None:
        self.computes += 1
        self._enter("compute")

    def did_set_rate(self, _old: float) -> None:
        self._enter("handler")

    def finalize(self) -> None:
        self.finalized.set()


def hanging(hangs_in: str, clock: SimulatedClock | None = None) -> tuple[Runner, Hanging]:
    settings = RunSettings(domain=f"test-{uuid.uuid4().hex[:8]}", middleware="inproc")
    runner = Runner(Hanging, ArmParams.load(), settings, clock)
    worker = runner.worker
    assert isinstance(worker, Hanging)
    worker.hangs_in = hangs_in
    runner.start()
    return runner, worker


def test_hanging_compute_ends_component_and_finalizes(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.ERROR, "robocomp"):
        runner, worker = hanging("compute")
        assert not runner.wait()
    worker.release.set()
    assert worker.finalized.is_set()
    assert runner.abandoned
    assert runner.hang
    assert runner.hang.activity == "compute"
    assert "self.release.wait(60)" in caplog.text


def test_hanging_handler_ends_component_and_finalizes() -> None:
    runner, worker = hanging("handler")
    host = ComponentContext("looker", runner.settings.domain, CallbackGroup(), Statistics())
    middleware = open_ports("inproc", host)
    proxy = ComponentProxy(middleware.proxy(Endpoint(COMPONENT, "looker", "Component")))
    thread = threading.Thread(target=proxy.setParameters, args=({"rate": "2"},), daemon=True)
    wait_until(lambda: worker.computes)
    thread.start()
    assert not runner.wait()
    assert worker.finalized.is_set()
    assert runner.hang
    worker.release.set()
    thread.join(30)
    middleware.close()


def test_watchdog_exempts_initialize() -> None:
    runner, worker = hanging("initialize")
    assert runner.watchdog
    state = runner.lifecycle.state
    wait_until(lambda: runner.callback_group.holders)
    runner.watchdog.check(0.0)
    assert runner.watchdog.check(100.0) is None
    assert runner.lifecycle.state is state
    worker.release.set()
    wait_until(lambda: worker.computes)
    runner.stop()
    assert runner.wait()


def test_loop_that_waits_for_simulated_time_does_not_hang() -> None:
    clock = SimulatedClock()
    entered = threading.Event()
    wait_for_time = clock.wait_until

    def wait(moment: float | None, wake: WakeEvent) -> None:
        entered.set()
        wait_for_time(moment, wake)

    clock.wait_until = wait  # type: ignore[method-assign]
    runner, worker = hanging("", clock)
    assert entered.wait(30)
    assert runner.watchdog
    wait_until(lambda: not runner.callback_group.holders)
    runner.watchdog.check(0.0)
    assert runner.watchdog.check(100.0) is None
    runner.stop()
    assert runner.wait()
    assert not worker.computes


PROGRAM = """
import os, sys, threading
from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.entry_point import main

class Hanging(Component):
    SPEC = ComponentSpec(name="hanging", period=1, middleware="inproc")
    def compute(self):
        threading.Event().wait()
    def finalize(self):
        print("finalized", flush=True)

sys.exit(main(Hanging))
"""


def run_program(*arguments: str, descriptor: int | None = None) -> subprocess.CompletedProcess[str]:
    environment = dict(os.environ)
    if descriptor is not None:
        environment["ROBOCOMP_HEARTBEAT_FD"] = str(descriptor)
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        capture_output=True, text=True, check=False, timeout=60, env=environment,
        pass_fds=() if descriptor is None else (descriptor,),
    )  # fmt: skip


def test_process_with_watchdog_option_reports_exits_and_finalizes() -> None:
    reading, writing = os.pipe()
    finished = run_program("--watchdog", "0.2", descriptor=writing)
    os.close(writing)
    with os.fdopen(reading) as stream:
        lines = stream.read().splitlines()
    assert finished.returncode == 1
    assert finished.stdout == "finalized\n"
    assert "watchdog: compute has hung for" in finished.stderr
    assert lines[0] == "0.2"
    assert lines[-2] == "0"
    assert HangReport.from_json(lines[-1]).activity == "compute"


@pytest.mark.parametrize("value", ["-1", "nan", "1e9", "x"])
def test_watchdog_option_out_of_range_is_refused(value: str) -> None:
    finished = run_program(f"--watchdog={value}")
    assert finished.returncode == 2
    assert "--watchdog" in finished.stderr


class SlowClock:
    """A wall clock on which every look costs three periods."""

    reset_count, is_stale = 0, False

    def __init__(self) -> None:
        self._seconds = 0.0

    def now(self) -> float:
        self._seconds += 0.003
        return self._seconds

    def wait_until(self, _moment: float | None, wake: WakeEvent) -> None:
        wake.wait(0.0001)


def test_overruns_are_counted_and_logged_once(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING, "robocomp"):
        runner, _ = hanging("", SlowClock())  # type: ignore[arg-type]
        wait_until(lambda: runner.statistics.overruns > 20)
        runner.stop()
        assert runner.wait()
    logged = [text for text in caplog.messages if "compute exceeded its period of 1 ms" in text]
    assert len(logged) == 1
    assert "overruns since the start: 1" in logged[0]
