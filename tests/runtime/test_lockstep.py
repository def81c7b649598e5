"""Lock-step: components with different periods give identical runs over each middleware."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime import Component
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from tests.runtime.lockstep_components import Base, Driver, Recorder, TimerOnly, running
from tests.support.waiting import wait_until


@pytest.fixture(params=["inproc", "zenoh"])
def middleware(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def record_run(middleware: str, order: list[type[Component]]) -> str:
    with running([Base, *order], middleware) as runners:
        base = runners["base"].worker
        wait_until(
            lambda: runners["base"].state is LifecycleState.COMPUTE and base.source.paused,
            "the end of the run",
        )
        wait_until(lambda: base.commands == 81, "the commands due at the end")
        return "\n".join(runners["recorder"].worker.lines)


def test_lockstep_runs_are_identical(middleware: str) -> None:
    first = record_run(middleware, [Driver, Recorder])
    assert record_run(middleware, [Recorder, Driver]) == first
    lines = first.splitlines()
    assert len(lines) == 201 + 118
    # each component computes at its own period, the source first
    assert [line.split(" ")[:2] for line in lines[:5]] == [
        ["0.0", "saw"],
        ["0.0", "is"],
        ["0.01", "saw"],
        ["0.017", "is"],
        ["0.02", "saw"],
    ]


def test_lockstep_machine_timers_fire_at_exact_times(middleware: str) -> None:
    with running([Base, TimerOnly], middleware) as runners:
        base = runners["base"].worker
        wait_until(
            lambda: runners["base"].state is LifecycleState.COMPUTE and base.source.paused,
            "the end of the run",
        )
        assert runners["timer"].worker.woken == [0.313, 0.726, 1.139, 1.552, 1.965]


def test_lockstep_reset_repeats_schedule(middleware: str) -> None:
    class Short(Recorder):
        pass

    with running([Base, Short], middleware) as runners:
        base, lines = runners["base"].worker, lambda: runners["recorder"].worker.lines
        wait_until(
            lambda: runners["base"].state is LifecycleState.COMPUTE and base.source.paused,
            "the end of the run",
        )
        seen = [line.split(" ")[0] for line in lines()]
        base.source.reset()
        base.source.resume()
        wait_until(
            lambda: base.source.paused and base.source.reset_count == 1, "the end of the second run"
        )
        assert [line.split(" ")[0] for line in lines()] == seen * 2
