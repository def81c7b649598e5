"""Errors that end a component: `finalize` runs, the exit code is not 0, and the line is logged."""

from __future__ import annotations

import asyncio
import logging
import subprocess
import sys
import threading
import uuid
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component import runner as runner_module
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.parameters import Parameters

FAILURES = (SystemExit(0), SystemExit(3), KeyboardInterrupt(), asyncio.CancelledError())


class Fragile(Component):
    """Raises `failure` in the hook `fails_in`, or calls `act` there."""

    SPEC = ComponentSpec(name="fragile", period=1, middleware="inproc")
    fails_in = "compute"
    act: Callable[[], None] = staticmethod(lambda: None)

    def __init__(self) -> None:
        self.hooks: list[str] = []

    def _enter(self, hook: str) -> None:
        self.hooks.append(hook)
        if hook == self.fails_in:
            self.act()

    def initialize(self) -> None:
        self._enter("initialize")

    def compute(self) -> None:
        self._enter("compute")

    def finalize(self) -> None:
        self._enter("finalize")


def start(hook: str, act: Callable[[], None]) -> Runner:
    settings = RunSettings(domain=f"test-{uuid.uuid4().hex[:8]}", middleware="inproc")
    runner = Runner(Fragile, Parameters(), settings)
    worker = runner.worker
    assert isinstance(worker, Fragile)
    worker.fails_in, worker.act = hook, act
    runner.start()
    return runner


def hooks_of(runner: Runner) -> list[str]:
    assert isinstance(runner.worker, Fragile)
    return runner.worker.hooks


@pytest.mark.parametrize("hook", ["initialize", "compute", "finalize"])
@pytest.mark.parametrize("failure", FAILURES, ids=repr)
def test_base_exception_in_hook_finalizes_and_fails(
    hook: str, failure: BaseException, caplog: pytest.LogCaptureFixture
) -> None:
    def fail() -> None:
        raise failure

    with caplog.at_level(logging.ERROR, "robocomp"):
        runner = start(hook, fail)
        if hook == "finalize":
            runner.stop()
        assert not runner.wait()
    assert hooks_of(runner)[-1] == "finalize"
    assert hooks_of(runner).count(hook) == 1
    line = fail.__code__.co_firstlineno + 1
    assert f"{type(failure).__name__}" in caplog.text
    assert f"{Path(__file__).name}:{line}" in caplog.text


def test_system_exit_in_compute_names_quit(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.ERROR, "robocomp"):
        assert not start("compute", sys.exit).wait()
    assert "to end a component normally, call self.quit()" in caplog.text


def test_fault_while_opening_ports_finalizes_and_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_runner: Runner) -> None:
        raise MiddlewareError("the port is taken")

    monkeypatch.setattr(Runner, "_open", refuse)
    runner = start("", lambda: None)
    assert not runner.wait()
    assert hooks_of(runner) == ["initialize", "finalize"]


@pytest.fixture
def short_timeouts(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("INTERRUPT_TIMEOUT_S", "SHUTDOWN_TIMEOUT_S"):
        monkeypatch.setattr(runner_module, name, 0.05)


def test_hanging_compute_does_not_prevent_finalize(short_timeouts: None) -> None:
    entered, release = threading.Event(), threading.Event()

    def hang() -> None:
        entered.set()
        release.wait(60)

    runner = start("compute", hang)
    entered.wait(30)
    runner.stop()
    assert not runner.wait()
    release.set()
    assert runner.abandoned
    assert hooks_of(runner) == ["initialize", "compute", "finalize"]


PROGRAM = """
import sys, threading
from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.entry_point import main

class Exiting(Component):
    SPEC = ComponentSpec(name="exiting", period=1, middleware="inproc")
    def compute(self):
        if "hang" in sys.argv[1]:
            threading.Thread(target=threading.Event().wait).start()
            self.quit()
            threading.Event().wait()
        sys.exit(0)
    def finalize(self):
        print("finalized", flush=True)

sys.exit(main(Exiting, []))
"""


@pytest.mark.parametrize("how", ["exit", "hang"])
def test_process_of_failed_component_exits_with_code_1(how: str) -> None:
    """A user thread that never ends does not keep the process of a hanging component alive."""
    finished = subprocess.run(
        [sys.executable, "-c", PROGRAM, how],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert finished.returncode == 1
    assert finished.stdout == "finalized\n"
