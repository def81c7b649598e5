"""Simulated time: the clock of its source, the clocks that follow it, and `--clock`."""

from __future__ import annotations

import argparse
import threading
import time
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import count
from typing import Any

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
from robocomp_dsl.runtime.time.clock_settings import ClockSettings, parse_clock
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock

DEADLINE = 60.0
NANO = 1_000_000_000


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("wall", ClockSettings()),
        ("sim", ClockSettings("sim")),
        ("sim,from=body", ClockSettings("sim", "body")),
        ("lockstep,from=body,with=b+a", ClockSettings("lockstep", "body", ("a", "b"))),
        (
            "lockstep,limit=2.5,lost=stop",
            ClockSettings("lockstep", limit=2.5, stops_when_lost=True),
        ),
    ],
)
def test_words_of_the_option(text: str, meant: ClockSettings) -> None:
    assert parse_clock(text) == meant
    assert parse_clock(meant.as_text()) == meant


@pytest.mark.parametrize(
    "text", ["", "ros", "sim,from=", "sim,by=x", "lockstep,limit=0", "lockstep,lost=maybe", "sim,"]
)
def test_words_that_are_none(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError):
        parse_clock(text)


class Wall:
    """A wall clock that goes on by itself, a little at each look."""

    def __init__(self, tick: float = 0.001) -> None:
        self.moment = 100.0
        self.tick = tick

    def __call__(self) -> float:
        self.moment += self.tick
        return self.moment


def began(speed: float = 1.0, tick: float = 0.001) -> tuple[ClockSource, list[Tick], Wall]:
    ticks: list[Tick] = []
    wall = Wall(tick)
    source = ClockSource(ticks.append, speed=speed, wall=wall)
    assert source.reset_count == -1
    source.wait_until(0.0, WakeEvent())
    return source, ticks, wall


@pytest.mark.parametrize(("speed", "least"), [(1, 0.4), (4, 0.1), (0, 0.0)])
def test_a_source_paces_itself(speed: float, least: float) -> None:
    ticks: list[Tick] = []
    source = ClockSource(ticks.append, speed=speed)
    source.wait_until(0.0, WakeEvent())
    begun = time.monotonic()
    for number in range(1, 51):
        source.wait_until(number / 100, WakeEvent())
        assert source.now() == number / 100
    took = time.monotonic() - begun
    assert took >= least
    assert [tick.time for tick in ticks] == [n * 10_000_000 for n in range(51)]
    # another load on the machine may hold it up, so there is no upper bound in time


def test_a_source_that_was_held_up_tells_a_smaller_factor() -> None:
    source, ticks, wall = began(tick=0.0)
    for number in range(1, 200):
        wall.moment += 0.02  # each step of 10 ms takes 20
        source.wait_until(number / 100, WakeEvent())
    assert ticks[-1].realTimeFactor == pytest.approx(0.5, abs=0.03)


def test_a_pause_holds_and_a_step_lets_some_time_pass() -> None:
    source, ticks, _ = began(speed=0)
    source.pause()
    reached = threading.Event()

    def live() -> None:
        source.wait_until(0.01, WakeEvent())
        reached.set()

    thread = threading.Thread(target=live)
    thread.start()
    until(lambda: ticks[-1].paused)
    assert source.now() == 0.0
    assert not reached.is_set()
    source.step(0.004)
    assert source.wait_step_done(DEADLINE)
    assert source.now() == 0.004
    assert not reached.is_set()
    source.step(0.006)
    thread.join(DEADLINE)
    assert source.now() == 0.01
    assert source.paused
    source.step(0.01)
    assert not source.wait_step_done(0.01), "nobody waits for this time"
    source.resume()
    source.wait_until(0.02, WakeEvent())
    assert source.now() == 0.02
    assert not ticks[-1].paused


def test_a_reset_ends_the_wait() -> None:
    source, ticks, _ = began(speed=0)
    source.wait_until(5.0, WakeEvent())
    source.reset()
    source.wait_until(5.01, WakeEvent())
    assert (source.now(), source.reset_count) == (0.0, 1)
    source.wait_until(0.01, WakeEvent())
    assert ticks[-1].time == 10_000_000
    assert ticks[-1].epoch == 1


def test_time_may_begin_anew_at_another_moment() -> None:
    source, ticks, _ = began(speed=0)
    source.reset(2.5)
    source.wait_until(0.01, WakeEvent())
    assert (source.now(), source.reset_count) == (2.5, 1)
    source.wait_until(2.51, WakeEvent())
    assert [(tick.time, tick.epoch) for tick in ticks[-2:]] == [
        (2_500_000_000, 1),
        (2_510_000_000, 1),
    ]


def test_what_is_carried_along_is_there_first() -> None:
    source, ticks, _ = began(speed=0)
    moves: list[tuple[float, int, int]] = []
    source.set_pre_tick_hook(lambda seconds, epoch: moves.append((seconds, epoch, ticks[-1].time)))
    source.wait_until(0.01, WakeEvent())
    source.pause()
    thread = threading.Thread(target=lambda: source.wait_until(0.02, WakeEvent()))
    thread.start()
    for _ in range(2):
        source.step(0.005)
        assert source.wait_step_done(DEADLINE)
    thread.join(DEADLINE)
    assert moves == [(0.01, 0, 0), (0.015, 0, 10_000_000), (0.02, 0, 15_000_000)]


def test_what_is_carried_along_may_begin_time_anew() -> None:
    source, ticks, _ = began(speed=0)
    source.set_pre_tick_hook(lambda _seconds, _epoch: source.reset())
    source.wait_until(0.01, WakeEvent())
    assert (source.now(), source.reset_count, ticks[-1].time) == (0.0, 1, 0)


@pytest.mark.parametrize("speed", [-1.0, float("nan"), float("inf")])
def test_speeds_that_are_none(speed: float) -> None:
    source, _, _ = began()
    with pytest.raises(ValueError, match="invalid speed"):
        source.set_speed(speed)


def until(condition: Callable[[], Any]) -> None:
    end = time.monotonic() + DEADLINE
    turn = threading.Event()
    while not condition():
        assert time.monotonic() < end, "it did not come to pass"
        turn.wait(0.002)


class Counter(Component):
    """Writes down the time of each compute."""

    SPEC = ComponentSpec(name="counter", period=20, middleware="inproc")

    def __init__(self) -> None:
        self.times: list[float] = []

    def compute(self) -> None:
        self.times.append(self.clock.now())


class Sleeper(Component):
    """A state machine that only time moves."""

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
    """Makes the time."""

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


def test_components_wait_for_the_first_tick_and_follow() -> None:
    domain = uuid.uuid4().hex
    with running(Counter, domain, "sim") as counter, running(Sleeper, domain, "sim") as sleeper:
        until(lambda: counter.state is sleeper.state is LifecycleState.COMPUTE)
        assert isinstance(clock := counter.worker.clock, SimulatedClock)
        ticks = hearing(counter), hearing(sleeper)
        assert counter.worker.times == []
        ticks[0](Tick(0))
        until(lambda: counter.worker.times == [0.0])
        for number in range(1, 102):
            for tick in ticks:
                tick(Tick(number * 10_000_000))
            # Its time is to begin with its first tick, not with one that comes before it has woken.
            until(lambda: sleeper.lifecycle.machine.next_due() in (1.01, None))
            until(lambda n=number: len(counter.worker.times) == n // 2 + 1)
        assert counter.worker.times == [n * 20 / 1000 for n in range(51)]
        until(lambda: sleeper.worker.woken == [1.01])
        assert clock.now() == 1.01

        # a reset: the grid begins anew
        for tick in ticks:
            tick(Tick(5_000_000, epoch=1))
        until(lambda: counter.worker.times[51:] == [0.005])
        for tick in ticks:
            tick(Tick(25_000_000, epoch=1))
        until(lambda: counter.worker.times[51:] == [0.005, 0.025])


def hearing(runner: Runner) -> Callable[[Tick], None]:
    clock = runner.worker.clock
    assert isinstance(clock, SimulatedClock)
    return clock.on_tick


@pytest.mark.parametrize("kind", [Counter, Sleeper])
def test_a_source_that_falls_silent_is_an_emergency_until_it_is_heard(
    kind: type[Component],
) -> None:
    """By the clock of the machine, as there is no other; time goes on from where it stood."""
    clock = SimulatedClock(timeout=0.05)
    runner = Runner(kind, Parameters(), RunSettings(domain=uuid.uuid4().hex), clock)
    recovered = []
    runner.worker.restore = lambda: recovered.append(clock.now())
    runner.start()
    try:
        until(lambda: runner.state is LifecycleState.COMPUTE)
        clock.on_tick(Tick(20_000_000))
        until(lambda: runner.state is LifecycleState.EMERGENCY)
        assert "simulated clock lost" in runner.lifecycle.reason
        assert clock.is_stale
        moments = count(40_000_000, 1_000_000)
        until(lambda: clock.on_tick(Tick(next(moments))) or recovered)
        until(lambda: clock.on_tick(Tick(next(moments))) or runner.state is LifecycleState.COMPUTE)
        assert 0.02 < recovered[0] <= clock.now()
        times = getattr(runner.worker, "times", [0.02, 0.04])
        assert times == sorted(times)
        assert len(times) >= 2
    finally:
        runner.stop()
        assert runner.wait()


def test_a_source_that_never_was_is_waited_for() -> None:
    clock, wake = SimulatedClock(timeout=0.01), WakeEvent()
    threading.Timer(0.05, wake.set).start()
    clock.wait_until(0.0, wake)
    assert not clock.is_stale


def test_a_slow_source_says_that_it_is_there() -> None:
    ticks: list[Tick] = []
    source, wake = ClockSource(ticks.append, speed=0.001), WakeEvent()
    source.wait_until(0.0, WakeEvent())
    waiting = threading.Thread(target=source.wait_until, args=(10.0, wake))
    waiting.start()
    until(lambda: len(ticks) >= 3)
    wake.set()
    waiting.join(DEADLINE)
    assert {tick.time for tick in ticks} == {0}


def test_a_timer_begins_again_with_the_time() -> None:
    with running(Sleeper, uuid.uuid4().hex, "sim") as sleeper:
        until(lambda: sleeper.state is LifecycleState.COMPUTE)
        tick = hearing(sleeper)
        tick(Tick(7 * NANO))  # it came late
        until(lambda: sleeper.lifecycle.machine.next_due() == 8.0)
        tick(Tick(7 * NANO + NANO // 2))
        tick(Tick(0, epoch=1))
        until(lambda: sleeper.lifecycle.machine.next_due() == 1.0)
        assert sleeper.worker.woken == []
        tick(Tick(NANO, epoch=1))
        until(lambda: sleeper.worker.woken == [1.0])


def test_a_source_and_who_follows_it() -> None:
    domain = uuid.uuid4().hex
    with running(Counter, domain, "sim") as counter:
        until(lambda: counter.state is LifecycleState.COMPUTE)
        with running(Source, domain, "sim") as source:
            until(lambda: source.worker.clock.paused)
            assert source.worker.times == [n / 100 for n in range(201)]
            until(lambda: counter.worker.clock.now() == 2.0)
            assert len(counter.worker.times) > 0
            assert counter.worker.times == sorted(counter.worker.times)
            source.worker.last = 3.0
            source.worker.clock.resume()
            until(lambda: counter.worker.clock.now() == 3.0)


def test_the_wall_clock_stays_the_default() -> None:
    with running(Counter, uuid.uuid4().hex, "wall") as counter:
        until(lambda: len(counter.worker.times) > 2)
        assert abs(counter.worker.times[-1] - time.monotonic()) < DEADLINE
