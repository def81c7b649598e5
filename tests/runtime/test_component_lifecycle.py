"""The lifecycle of a component: hooks in order, emergencies, failures and overruns."""

from __future__ import annotations

import logging
import re
import time
import uuid

import pytest

from robocomp_dsl.runtime.component.component_interface import ComponentProxy, LifeState
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from tests.runtime.arm_component import Arm, ArmParams, arm_of
from tests.support.waiting import wait_until


def test_component_calls_hooks_in_lifecycle_order(arm_runner: Runner) -> None:
    arm = arm_of(arm_runner)
    wait_until(lambda: arm.calls.count("compute") >= 3)
    arm.quit()
    assert arm_runner.wait()
    assert arm.calls[0] == "initialize"
    assert arm.calls[-1] == "finalize"
    assert set(arm.calls[1:-1]) == {"compute"}
    assert arm_runner.state is LifecycleState.FINALIZE


def test_failing_compute_causes_emergency_that_restores_itself(
    arm_runner: Runner, arm_proxy: ComponentProxy, caplog: pytest.LogCaptureFixture
) -> None:
    arm = arm_of(arm_runner)
    wait_until(lambda: "compute" in arm.calls)
    arm.failing = True
    wait_until(lambda: arm.calls.count("restore") >= 2)
    info = arm_proxy.getInfo()
    assert info.state in (LifeState.Emergency, LifeState.Restore)
    assert re.search(
        r"RuntimeError: the arm does not move \(.*arm_component\.py:\d+\)", info.reason
    )
    reports = [r for r in caplog.records if "the arm does not move" in r.getMessage()]
    assert len([r for r in reports if r.levelno == logging.ERROR]) == 1
    arm.failing = False
    wait_until(lambda: arm_runner.state is LifecycleState.COMPUTE)
    assert arm_proxy.getInfo().reason == ""
    assert arm_proxy.getStatistics().failures >= 2


def test_declared_emergency_lasts_until_end_emergency(
    arm_runner: Runner, caplog: pytest.LogCaptureFixture
) -> None:
    arm = arm_of(arm_runner)
    wait_until(lambda: "compute" in arm.calls)
    for _ in range(3):
        arm.declare_emergency("the button")
    assert [r.getMessage() for r in caplog.records].count("emergency: the button") == 1
    wait_until(lambda: arm.calls.count("emergency") >= 3)
    assert "restore" not in arm.calls
    assert arm_runner.lifecycle.reason == "the button"
    arm.end_emergency()
    wait_until(lambda: arm_runner.state is LifecycleState.COMPUTE)
    assert "restore" in arm.calls


def test_emergency_declared_in_initialize_prevents_compute() -> None:
    class EmergencyAtStart(Arm):
        def initialize(self) -> None:
            super().initialize()
            self.declare_emergency("the brakes are on")

    braked = Runner(EmergencyAtStart, ArmParams.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    braked.start()
    arm = arm_of(braked)
    wait_until(lambda: arm.calls.count("emergency") >= 3)
    assert (braked.state, braked.lifecycle.reason) == (
        LifecycleState.EMERGENCY,
        "the brakes are on",
    )
    assert "compute" not in arm.calls
    arm.end_emergency()
    wait_until(lambda: braked.state is LifecycleState.COMPUTE)
    braked.stop()
    assert braked.wait()


def test_failing_initialize_ends_component(caplog: pytest.LogCaptureFixture) -> None:
    class FailingInitialize(Arm):
        def initialize(self) -> None:
            raise OSError("no such bus")

    failing = Runner(FailingInitialize, ArmParams.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    failing.start()
    assert not failing.wait()
    assert arm_of(failing).calls == ["finalize"]
    assert re.search(r"initialize failed: OSError: no such bus \(.*:\d+\)", caplog.text)


def test_statistics_count_period_overruns() -> None:
    class Slow(Arm):
        def compute(self) -> None:
            end = time.perf_counter() + 0.004
            while time.perf_counter() < end:
                pass
            self.calls.append("compute")

    slow = Runner(Slow, ArmParams.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    slow.start()
    wait_until(lambda: slow.statistics.overruns >= 3)
    slow.stop()
    assert slow.wait()
