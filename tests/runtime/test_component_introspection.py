"""The interface `Component`: information, parameters, period, log level and stop."""

from __future__ import annotations

import logging
import os

import pytest

from robocomp_dsl.runtime.component.component_interface import ComponentProxy, LifeState, Refusal
from robocomp_dsl.runtime.component.runner import Runner
from tests.runtime.arm_component import arm_of
from tests.support.waiting import wait_until


def test_component_interface_reports_info_parameters_and_statistics(
    arm_runner: Runner, arm_proxy: ComponentProxy
) -> None:
    wait_until(lambda: arm_runner.statistics.computes.count > 3)
    info = arm_proxy.getInfo()
    assert (info.name, info.component, info.pid) == ("arm", "arm", os.getpid())
    assert info.state is LifeState.Compute
    rate, device, weights = arm_proxy.getParameters()
    assert (rate.name, rate.unit, rate.low, rate.high, rate.live) == (
        "rate",
        "Hz",
        "1",
        "100",
        True,
    )
    assert (device.value, device.live) == ("/dev/null", False)
    assert (weights.type, weights.value, weights.high) == ("float[1:3]", "[1.0]", "9")
    figures = arm_proxy.getStatistics()
    assert figures.period == 1
    assert figures.cycles > 3
    assert "getInfo" in {operation.operation for operation in figures.operations}


def test_set_parameters_changes_live_values_or_nothing(
    arm_runner: Runner, arm_proxy: ComponentProxy
) -> None:
    arm = arm_of(arm_runner)
    arm_proxy.setParameters({"rate": "20"})
    assert arm.params.rate == 20
    wait_until(lambda: "rate was 50" in arm.calls)
    for changes, message in (
        ({"rate": "500"}, "100"),
        ({"rate": "fast"}, "number"),
        ({"rates": "20"}, "rate"),
        ({"device": "/dev/tty"}, "live"),
        ({"weights": "1, 2, x"}, "`weights[2]` must be a number, not `x`"),
        ({"weights": "1, 2, 3, 4"}, "`weights` has 4 elements, it must have 1 to 3"),
        ({"weights[1]": "2"}, "`weights` has 1 element, there is no [1]"),
    ):
        with pytest.raises(Refusal) as caught:
            arm_proxy.setParameters(changes)
        assert message in caught.value.reason
    arm_proxy.setParameters({"weights": "[2, 3]", "weights[1]": "4"})
    assert arm.params.weights == [2.0, 4.0]
    arm.refusing = True
    with pytest.raises(Refusal) as caught:
        arm_proxy.setParameters({"rate": "30"})
    assert "not while moving" in caught.value.reason
    assert arm.params.rate == 20


def test_set_period_changes_running_period(arm_runner: Runner, arm_proxy: ComponentProxy) -> None:
    arm = arm_of(arm_runner)
    arm_proxy.setPeriod(0)
    wait_until(lambda: arm_runner.lifecycle.period_ms == 0)
    with pytest.raises(Refusal):
        arm_proxy.setPeriod(-1)
    count = arm.calls.count("compute")
    arm_proxy.setPeriod(1)
    wait_until(lambda: arm.calls.count("compute") > count + 2)


def test_set_log_level_changes_root_logger(arm_proxy: ComponentProxy) -> None:
    before = logging.getLogger().level
    try:
        arm_proxy.setLogLevel("error")
        assert logging.getLogger().level == logging.ERROR
        with pytest.raises(Refusal, match="loud"):
            arm_proxy.setLogLevel("loud")
    finally:
        logging.getLogger().setLevel(before)


def test_stop_operation_ends_component(arm_runner: Runner, arm_proxy: ComponentProxy) -> None:
    arm_proxy.stop()
    assert arm_runner.wait()
