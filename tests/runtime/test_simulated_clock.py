"""Components on a simulated clock: first tick, stale clock, resets, and a source in a component."""

from __future__ import annotations

import threading
import time
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import count

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.clock import WakeEvent
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort
from robocomp_dsl.runtime.machine import MachineSpec, StateSpec, TransitionSpec
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_interface import ClockProxy, Tick
from robocomp_dsl.runtime.time.clock_settings import parse_clock
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from tests.support.waiting import wait_until

DEADLINE = 60.0
NANO = 1_000_000_000


class Counter(Component):
    """Records the time of each compute."""

    SPEC = ComponentSpec(name="counter", period=20, middleware="inproc")

    def __init__(self) -> None:
        self.times: list[float] = []

    def compute(self) -> None:
        self.times.append(self.clock.now())


class Sleeper(Component):
    """A state machine with time transitions only."""

    SPEC = ComponentSpec(
        name="sleeper",
        period=0,
        middleware="inproc",
        machine=MachineSpec(
            "nap",
            (StateSpec("asleep", initial=True), StateSpec("awake")),
            (TransitionSpec("asleep", "awake", after=1.0),),
        ),
    )

    def __init__(self) -> None:
        self.woken: list[float] = []

    def on_enter_awake(self) -> None:
        self.woken.append(self.clock.now())


class Source(Component):
    """The source of simulated time: one tick per compute."""

    SPEC = ComponentSpec(
        name="source",
        period=10,
        middleware="inproc",
        publishes=(CalledPort("Clock", ClockProxy, "clock_proxy"),),
    )
    clock_proxy: ClockProxy
    last = 2.0

    def initialize(self) -> None:
        assert isinstance(self.clock, ClockSource)
        self.clock.set_speed(0)
        self.times: list[float] = []

    def compute(self) -> None:
        self.times.append(self.clock.now())
        if self.clock.now() >= self.last:
            assert isinstance(self.clock, ClockSource)
            self.clock.pause()


@contextmanager
def running(kind: type[Component], domain: str, clock: str) -> Iterator[Runner]:
    runner = Runner(kind, Parameters(), RunSettings(domain=domain, clock=parse_clock(clock)))
    runner.start()
    try:
        yield runner
    finally:
        runner.stop()
        assert runner.wait()


def test_components_wait_for_first_tick_and_follow_simulated_clock() -> None:
    domain = uuid.uuid4().hex
    with running(Counter, domain, "sim") as counter, running(Sleeper, domain, "sim") as sleeper:
        wait_until(lambda: counter.state is sleeper.state is LifecycleState.COMPUTE)
        assert isinstance(clock := counter.worker.clock, SimulatedClock)
        ticks = tick_callback(counter), tick_callback(sleeper)
        assert counter.worker.times == []
        ticks[0](Tick(0))
        wait_until(lambda: counter.worker.times == [0.0])
        for number in range(1, 102):
            for tick in ticks:
                tick(Tick(number * 10_000_000))
            # Its timer starts with the first tick that it has processed.
            wait_until(lambda: sleeper.lifecycle.machine.next_due() in (1.01, None))
            wait_until(lambda n=number: len(counter.worker.times) == n // 2 + 1)
        assert counter.worker.times == [n * 20 / 1000 for n in range(51)]
        wait_until(lambda: sleeper.worker.woken == [1.01])
        assert clock.now() == 1.01

        # a reset: the schedule restarts
        for tick in ticks:
            tick(Tick(5_000_000, epoch=1))
        wait_until(lambda: counter.worker.times[51:] == [0.005])
        for tick in ticks:
            tick(Tick(25_000_000, epoch=1))
        wait_until(lambda: counter.worker.times[51:] == [0.005, 0.025])


def tick_callback(runner: Runner) -> Callable[[Tick], None]:
    clock = runner.worker.clock
    assert isinstance(clock, SimulatedClock)
    return clock.on_tick


@pytest.mark.parametrize("kind", [Counter, Sleeper])
def test_stale_simulated_clock_causes_emergency_until_next_tick(
    kind: type[Component],
) -> None:
    """Wall time decides that the clock is stale; simulated time continues where it stopped."""
    clock = SimulatedClock(timeout=0.05)
    runner = Runner(kind, Parameters(), RunSettings(domain=uuid.uuid4().hex), clock)
    recovered = []
    runner.worker.restore = lambda: recovered.append(clock.now())
    runner.start()
    try:
        wait_until(lambda: runner.state is LifecycleState.COMPUTE)
        clock.on_tick(Tick(20_000_000))
        wait_until(lambda: runner.state is LifecycleState.EMERGENCY)
        assert "simulated clock lost" in runner.lifecycle.reason
        assert clock.is_stale
        moments = count(40_000_000, 1_000_000)
        wait_until(lambda: clock.on_tick(Tick(next(moments))) or recovered)
        wait_until(
            lambda: clock.on_tick(Tick(next(moments))) or runner.state is LifecycleState.COMPUTE
        )
        assert 0.02 < recovered[0] <= clock.now()
        times = getattr(runner.worker, "times", [0.02, 0.04])
        assert times == sorted(times)
        assert len(times) >= 2
    finally:
        runner.stop()
        assert runner.wait()


def test_simulated_clock_without_first_tick_is_not_stale() -> None:
    clock, wake = SimulatedClock(timeout=0.01), WakeEvent()
    threading.Timer(0.05, wake.set).start()
    clock.wait_until(0.0, wake)
    assert not clock.is_stale


def test_machine_timer_restarts_after_clock_reset() -> None:
    with running(Sleeper, uuid.uuid4().hex, "sim") as sleeper:
        wait_until(lambda: sleeper.state is LifecycleState.COMPUTE)
        tick = tick_callback(sleeper)
        tick(Tick(7 * NANO))  # the first tick is late
        wait_until(lambda: sleeper.lifecycle.machine.next_due() == 8.0)
        tick(Tick(7 * NANO + NANO // 2))
        tick(Tick(0, epoch=1))
        wait_until(lambda: sleeper.lifecycle.machine.next_due() == 1.0)
        assert sleeper.worker.woken == []
        tick(Tick(NANO, epoch=1))
        wait_until(lambda: sleeper.worker.woken == [1.0])


def test_component_follows_clock_source_component() -> None:
    domain = uuid.uuid4().hex
    with running(Counter, domain, "sim") as counter:
        wait_until(lambda: counter.state is LifecycleState.COMPUTE)
        with running(Source, domain, "sim") as source:
            wait_until(lambda: source.worker.clock.paused)
            assert source.worker.times == [n / 100 for n in range(201)]
            wait_until(lambda: counter.worker.clock.now() == 2.0)
            wait_until(lambda: len(counter.worker.times) > 0)
            assert counter.worker.times == sorted(counter.worker.times)
            source.worker.last = 3.0
            source.worker.clock.resume()
            wait_until(lambda: counter.worker.clock.now() == 3.0)


def test_wall_clock_is_monotonic_time() -> None:
    with running(Counter, uuid.uuid4().hex, "wall") as counter:
        wait_until(lambda: len(counter.worker.times) > 2)
        assert abs(counter.worker.times[-1] - time.monotonic()) < DEADLINE
