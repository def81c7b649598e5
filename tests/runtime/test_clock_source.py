"""The source of simulated time: pace, pause, steps, resets and heartbeat."""

from __future__ import annotations

import threading
import time

import pytest

from robocomp_dsl.runtime.clock import WakeEvent
from robocomp_dsl.runtime.time.clock_interface import Tick
from robocomp_dsl.runtime.time.clock_source import ClockSource
from tests.support.waiting import wait_until

DEADLINE = 60.0


class ManualWallClock:
    """A wall clock that advances by `tick` at each reading."""

    def __init__(self, tick: float = 0.001) -> None:
        self.moment = 100.0
        self.tick = tick

    def __call__(self) -> float:
        self.moment += self.tick
        return self.moment


def start_source(
    speed: float = 1.0, tick: float = 0.001
) -> tuple[ClockSource, list[Tick], ManualWallClock]:
    """A source at time 0, the list of its ticks, and its wall clock."""
    ticks: list[Tick] = []
    wall = ManualWallClock(tick)
    source = ClockSource(ticks.append, speed=speed, wall=wall)
    assert source.reset_count == -1
    source.wait_until(0.0, WakeEvent())
    return source, ticks, wall


@pytest.mark.parametrize(("speed", "least"), [(1, 0.4), (4, 0.1), (0, 0.0)])
def test_clock_source_paces_itself(speed: float, least: float) -> None:
    ticks: list[Tick] = []
    source = ClockSource(ticks.append, speed=speed)
    source.wait_until(0.0, WakeEvent())
    begin = time.monotonic()
    for number in range(1, 51):
        source.wait_until(number / 100, WakeEvent())
        assert source.now() == number / 100
    duration = time.monotonic() - begin
    assert duration >= least
    assert [tick.time for tick in ticks] == [n * 10_000_000 for n in range(51)]
    # other load on the machine may delay the source, so the duration has no upper bound


def test_clock_source_reports_real_time_factor_when_delayed() -> None:
    source, ticks, wall = start_source(tick=0.0)
    for number in range(1, 200):
        wall.moment += 0.02  # each step of 10 ms takes 20
        source.wait_until(number / 100, WakeEvent())
    assert ticks[-1].realTimeFactor == pytest.approx(0.5, abs=0.03)


def test_clock_source_pauses_and_steps() -> None:
    source, ticks, _ = start_source(speed=0)
    source.pause()
    reached = threading.Event()

    def advance() -> None:
        source.wait_until(0.01, WakeEvent())
        reached.set()

    thread = threading.Thread(target=advance)
    thread.start()
    wait_until(lambda: ticks[-1].paused)
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
    assert not source.wait_step_done(0.01), "no thread waits for this time"
    source.resume()
    source.wait_until(0.02, WakeEvent())
    assert source.now() == 0.02
    assert not ticks[-1].paused


def test_clock_source_reset_ends_wait() -> None:
    source, ticks, _ = start_source(speed=0)
    source.wait_until(5.0, WakeEvent())
    source.reset()
    source.wait_until(5.01, WakeEvent())
    assert (source.now(), source.reset_count) == (0.0, 1)
    source.wait_until(0.01, WakeEvent())
    assert ticks[-1].time == 10_000_000
    assert ticks[-1].epoch == 1


def test_clock_source_reset_to_given_time() -> None:
    source, ticks, _ = start_source(speed=0)
    source.reset(2.5)
    source.wait_until(0.01, WakeEvent())
    assert (source.now(), source.reset_count) == (2.5, 1)
    source.wait_until(2.51, WakeEvent())
    assert [(tick.time, tick.epoch) for tick in ticks[-2:]] == [
        (2_500_000_000, 1),
        (2_510_000_000, 1),
    ]


def test_clock_source_calls_pre_tick_hook_before_tick() -> None:
    source, ticks, _ = start_source(speed=0)
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


def test_clock_source_pre_tick_hook_may_reset_time() -> None:
    source, ticks, _ = start_source(speed=0)
    source.set_pre_tick_hook(lambda _seconds, _epoch: source.reset())
    source.wait_until(0.01, WakeEvent())
    assert (source.now(), source.reset_count, ticks[-1].time) == (0.0, 1, 0)


@pytest.mark.parametrize("speed", [-1.0, float("nan"), float("inf")])
def test_clock_source_rejects_invalid_speed(speed: float) -> None:
    source, _, _ = start_source()
    with pytest.raises(ValueError, match="invalid speed"):
        source.set_speed(speed)


def test_slow_clock_source_sends_heartbeat_ticks() -> None:
    ticks: list[Tick] = []
    source, wake = ClockSource(ticks.append, speed=0.001), WakeEvent()
    source.wait_until(0.0, WakeEvent())
    waiting = threading.Thread(target=source.wait_until, args=(10.0, wake))
    waiting.start()
    wait_until(lambda: len(ticks) >= 3)
    wake.set()
    waiting.join(DEADLINE)
    assert {tick.time for tick in ticks} == {0}
