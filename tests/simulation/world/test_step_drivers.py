"""The time of a world and that of its deployment: they move, stand still and begin anew as one."""

from __future__ import annotations

import math
import threading
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.runtime.clock import WakeEvent, WallClock
from robocomp_dsl.runtime.time.clock_interface import Tick
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from robocomp_dsl.simulation.stepping.clock_leader import ClockLeader
from robocomp_dsl.simulation.world.simulation import SimulationOptions
from tests.simulation.served_worlds import ROOM, Served, served
from tests.support.waiting import wait_until

DEADLINE = 120.0


class LifecycleThread:
    """The life cycle of the simulator in a thread: a moment every 10 ms, until `stop`."""

    def __init__(self, clock: ClockSource) -> None:
        self.clock, self.wake = clock, WakeEvent()
        self.computed: list[float] = []
        self._thread = threading.Thread(target=self._live)
        self._thread.start()

    def _live(self) -> None:
        self.clock.wait_until(0.0, self.wake)
        epoch, due = self.clock.reset_count, self.clock.now()
        while not self.wake.stopped:
            self.computed.append(self.clock.now())
            due += 0.01
            self.clock.wait_until(round(due, 9), self.wake)
            if self.clock.reset_count != epoch:
                epoch, due = self.clock.reset_count, self.clock.now()

    def stop(self) -> None:
        self.wake.stop()
        self._thread.join()


class ClockSourceWorld:
    """A world that makes the time; `apart` is by how much it was ever behind a tick."""

    def __init__(self, folder: Path, options: SimulationOptions) -> None:
        self.world: Served = served(folder, ROOM, options)
        self.ticks: list[Tick] = []
        self.apart = 0.0
        self.clock = ClockSource(self._tell)
        self.world.simulation.start(self.clock)
        self.hand = self.world.ports["Simulation"]
        self.life: LifecycleThread | None = None

    def _tell(self, tick: Tick) -> None:
        self.ticks.append(tick)
        self.apart = max(self.apart, tick.time / 1e9 - self.world.simulation.world.advanced_to)

    def live(self) -> None:
        self.life = LifecycleThread(self.clock)


@pytest.fixture
def source(tmp_path: Path, request: pytest.FixtureRequest) -> Any:
    clock_source_world = ClockSourceWorld(
        tmp_path, getattr(request, "param", SimulationOptions(speed=0))
    )
    yield clock_source_world
    if clock_source_world.life:
        clock_source_world.life.stop()


def test_clock_leader_advances_world_before_tick(source: ClockSourceWorld) -> None:
    source.live()
    wait_until(lambda: source.clock.now() > 1.0)
    source.hand.pause()
    state = source.hand.getState()
    assert state.paused
    assert source.apart < 1e-9
    assert state.time == pytest.approx(source.clock.now(), abs=1e-9)


def test_clock_leader_steps_world_with_clock(source: ClockSourceWorld) -> None:
    source.clock.pause()
    source.live()
    wait_until(lambda: source.clock.reset_count == 0)
    assert source.hand.step(3) == pytest.approx(0.006)
    assert source.ticks[-1].time == 6_000_000
    assert source.hand.step(100) == pytest.approx(0.206)
    wait_until(lambda: len(source.life.computed) == 21)  # type: ignore[union-attr]
    assert source.life.computed == [n / 100 for n in range(21)]  # type: ignore[union-attr]
    assert source.clock.paused


def test_clock_leader_step_times_out(
    source: ClockSourceWorld, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robocomp_dsl.simulation.stepping.clock_leader.STEP_TIMEOUT_S", 0.01)
    source.clock.pause()
    with pytest.raises(
        source.world.types.RoboCompSimulation_Refused, match=r"step timed out after 0\.01 s"
    ):
        source.hand.step(1)
    assert isinstance(source.world.simulation.step_driver, ClockLeader)
    assert source.clock.current_tick.time == 0


def test_clock_leader_resets_clock_with_world(source: ClockSourceWorld) -> None:
    source.clock.pause()
    source.live()
    wait_until(lambda: source.clock.reset_count == 0)
    source.hand.step(20)
    saved = source.hand.snapshot()
    source.hand.step(30)
    assert source.clock.current_tick.time == 100_000_000
    source.hand.restore(saved)
    assert (source.clock.current_tick.time, source.clock.reset_count) == (40_000_000, 1)
    assert source.hand.getState().time == pytest.approx(0.04)
    assert source.hand.step(5) == pytest.approx(0.05)
    source.hand.reset()
    assert (source.clock.current_tick.time, source.clock.reset_count) == (0, 2)
    assert source.hand.getState().time == 0.0
    assert source.hand.step(1) == pytest.approx(0.002)
    assert source.ticks[-1].epoch == 2


def test_clock_leader_resets_world_with_clock(source: ClockSourceWorld) -> None:
    source.clock.pause()
    source.live()
    wait_until(lambda: source.clock.reset_count == 0)
    source.world.ports["robot"].setSpeedBase(300.0, 0.0)
    source.hand.step(250)
    assert source.world.ports["robot"].getBaseState().z > 100
    source.clock.reset()
    wait_until(lambda: source.ticks[-1].epoch == 1)
    assert source.hand.step(1) == pytest.approx(0.002)
    assert source.world.ports["robot"].getBaseState().z == 0


def test_clock_leader_reports_speed_and_factor_of_clock(source: ClockSourceWorld) -> None:
    source.hand.setSpeed(4.0)
    source.live()
    wait_until(lambda: source.hand.getState().realTimeFactor > 0)
    state = source.hand.getState()
    assert state.speed == source.clock.speed == 4.0
    assert state.realTimeFactor == pytest.approx(source.clock.current_tick.realTimeFactor, abs=2)
    source.hand.pause()
    assert source.hand.getState().realTimeFactor == 0.0


@pytest.mark.parametrize(
    "source",
    [SimulationOptions(speed=0), SimulationOptions(speed=0, diverged="stop")],
    indirect=True,
)
def test_clock_leader_resets_or_pauses_after_divergence(source: ClockSourceWorld) -> None:
    source.clock.pause()
    source.live()
    wait_until(lambda: source.clock.reset_count == 0)
    source.hand.step(50)
    source.world.simulation.world.data.qvel[0] = math.inf
    source.clock.resume()
    if source.world.simulation.options.diverged == "stop":
        wait_until(lambda: source.hand.getState().failure)
        wait_until(lambda: source.ticks[-1].paused)
        assert source.clock.reset_count == 0
        source.hand.reset()
    wait_until(lambda: source.ticks[-1].epoch == 1 and source.ticks[-1].time > 0)
    state = source.hand.getState()
    assert (state.failure, state.paused) == ("", False)


def test_clock_follower_advances_world_with_clock(tmp_path: Path) -> None:
    world = served(tmp_path, ROOM)
    clock, hand = SimulatedClock(), world.ports["Simulation"]
    world.simulation.start(clock)
    keep_up = world.simulation.step_driver.update
    for number in range(11):
        clock.on_tick(Tick(number * 10_000_000, realTimeFactor=2.5))
        keep_up()
    state = hand.getState()
    assert (state.time, state.realTimeFactor) == (pytest.approx(0.1), 2.5)
    hand.pause()
    clock.on_tick(Tick(500_000_000))
    keep_up()
    assert hand.getState().time == pytest.approx(0.1)
    assert hand.step(5) == pytest.approx(0.11)
    hand.resume()
    clock.on_tick(Tick(510_000_000))
    keep_up()
    assert hand.getState().time == pytest.approx(0.12)
    clock.on_tick(Tick(0, epoch=1))
    keep_up()
    assert hand.getState().time == 0.0
    with pytest.raises(world.types.RoboCompSimulation_Refused, match="another component"):
        hand.setSpeed(2.0)
    assert "another component" in world.simulation.step_driver.validate_speed(2.0)
    assert world.simulation.step_driver.validate_speed(1.0) == ""


def test_wall_clock_selects_real_time_driver(tmp_path: Path) -> None:
    world = served(tmp_path, ROOM, SimulationOptions(speed=0))
    world.simulation.start(WallClock())
    try:
        wait_until(lambda: world.ports["Simulation"].getState().time > 1.0)
        world.ports["Simulation"].reset()
        assert world.ports["Simulation"].getState().failure == ""
    finally:
        world.simulation.stop()
    rests = world.simulation.time
    world.simulation.step_driver.update()
    assert world.simulation.time == rests
