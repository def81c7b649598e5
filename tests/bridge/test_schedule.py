"""Outputs with a rate: when they are due, on clocks that jump and cycles that are late."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.runtime.bridge.schedule import RateSchedule, common_period_ms

RATES = st.sampled_from([0.5, 1.0, 10.0, 25.0, 30.0, 50.0, 60.0, 100.0, 200.0])


@pytest.mark.parametrize(
    ("rates", "period"),
    [
        ((), 0.0),
        ((50,), 20.0),
        ((30,), 1000 / 30),
        ((50, 20), 10.0),
        ((30, 50), 1000 / 150),
        ((0, 20), 50.0),
        ((999, 1000), 1.0),
        ((0.1,), 10000.0),
        ((2000,), 0.5),
    ],
)
def test_common_period(rates: tuple[float, ...], period: float) -> None:
    found = common_period_ms({str(i): rate for i, rate in enumerate(rates)})
    assert found == pytest.approx(period)


@given(st.lists(RATES, min_size=1, max_size=4), st.integers(0, 1000))
def test_rate_schedule_sends_each_output_at_its_rate(rates: list[float], start: int) -> None:
    schedule = RateSchedule({str(i): rate for i, rate in enumerate(rates)})
    period = schedule.period_ms / 1000
    counts = dict.fromkeys(schedule.rates, 0)
    for cycle in range(round(20 / period)):
        for name in schedule.due(start + cycle * period):
            counts[name] += 1
    for name, rate in schedule.rates.items():
        assert counts[name] == pytest.approx(20 * rate, abs=1)


def test_rate_schedule_skips_missed_messages_and_keeps_phase() -> None:
    schedule = RateSchedule({"a": 10.0})
    assert schedule.due(0.0) == ["a"]
    assert schedule.due(0.56) == ["a"]
    assert schedule.due(0.58) == []
    assert schedule.due(0.6) == ["a"]


def test_rate_schedule_is_due_after_clock_reset() -> None:
    schedule = RateSchedule({"a": 1.0})
    assert schedule.due(1000.0) == ["a"]
    assert schedule.due(1000.1) == []
    assert schedule.due(0.0) == ["a"]
    assert schedule.due(0.1) == []


def test_rate_schedule_rate_changes_at_run_time() -> None:
    schedule = RateSchedule({"a": 1.0, "b": 0.0})
    schedule.due(0.0)
    schedule.set_rate("b", 10.0)
    assert schedule.due(0.1) == ["b"]
    schedule.set_rate("b", 0.0)
    assert schedule.due(1.0) == ["a"]
