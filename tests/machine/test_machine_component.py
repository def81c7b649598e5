"""A component with a state machine, from its start to the machine's end."""

from __future__ import annotations

import threading
import uuid
from collections.abc import Iterator
from dataclasses import replace

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.machine import MachineSpec, StateSpec, TransitionSpec
from robocomp_dsl.runtime.parameters import Parameters
from tests.machine.test_machine import GAME
from tests.support.waiting import wait_until

DEADLINE = 60.0


class Player(Component):
    """Plays until it is told to stop."""

    SPEC = ComponentSpec(name="player", period=1, middleware="inproc", machine=GAME)

    def __init__(self) -> None:
        self.happened: list[str] = []
        self.stop_playing = threading.Event()

    def initialize(self) -> None:
        self.happened.append("initialize")

    def compute(self) -> None:
        if self.happened[-1] != "compute":
            self.happened.append("compute")

    def on_enter_waiting(self) -> None:
        self.happened.append("enter waiting")

    def state_waiting(self) -> None:
        self.machine.send("start")

    def state_moves(self) -> None:
        if self.stop_playing.is_set():
            self.machine.send("pause")

    def finalize(self) -> None:
        self.happened.append("finalize")


class Waiter(Component):
    """Only reacts; time ends it."""

    MACHINE = MachineSpec(
        "waiter",
        (StateSpec("a", initial=True), StateSpec("z", final=True)),
        (TransitionSpec("a", "z", after=0.05),),
    )
    SPEC = ComponentSpec(name="waiter", period=0, middleware="inproc", machine=MACHINE)


@pytest.fixture
def runner() -> Iterator[Runner]:
    component = Runner(Player, Parameters.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    component.start()
    yield component
    component.stop()
    component.wait()


def test_machine_runs_with_its_component(runner: Runner) -> None:
    player = runner.worker
    assert isinstance(player, Player)
    wait_until(lambda: runner.worker.machine.is_in("playing"))
    assert player.happened[:3] == ["initialize", "enter waiting", "compute"]
    host = ComponentContext("looker", runner.settings.domain, CallbackGroup(), Statistics())
    middleware = open_ports("inproc", host)
    about = ComponentProxy(
        middleware.proxy(Endpoint(COMPONENT, "looker", "Component", ("player",)))
    )
    assert about.getInfo().states == ["playing", "music", "loud", "moves"]
    player.stop_playing.set()
    wait_until(lambda: about.getInfo().states == ["paused"])
    middleware.close()


def test_machine_end_ends_component() -> None:
    runner = Runner(Waiter, Parameters.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    runner.start()
    assert runner.wait()
    assert runner.worker.machine.ended


class Stumbler(Component):
    """Fails in a state's method, and again when it is entered by time; then it goes on."""

    SPEC = ComponentSpec(
        name="stumbler",
        period=1,
        middleware="inproc",
        machine=MachineSpec(
            "stumbler",
            (
                StateSpec("a", initial=True),
                StateSpec("b"),
                StateSpec("z", final=True),
            ),
            (TransitionSpec("a", "b", after=0.05), TransitionSpec("b", "z", "on")),
        ),
    )

    def __init__(self) -> None:
        self.failed: list[str] = []
        self.restored = 0

    def _fail(self, where: str) -> None:
        if where not in self.failed:
            self.failed.append(where)
            raise ZeroDivisionError(where)

    def state_a(self) -> None:
        self._fail("state_a")

    def on_enter_b(self) -> None:
        self._fail("on_enter_b")

    def state_b(self) -> None:
        self._fail("state_b")
        self.machine.send("on")

    def restore(self) -> None:
        self.restored += 1


def test_machine_failures_are_emergencies_and_component_recovers() -> None:
    runner = Runner(Stumbler, Parameters.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    runner.start()
    assert runner.wait()
    worker = runner.worker
    assert isinstance(worker, Stumbler)
    assert worker.machine.ended
    assert worker.failed == ["state_a", "on_enter_b", "state_b"]
    assert worker.restored == 3


class Reacting(Stumbler):
    """Without a period."""

    SPEC = replace(Stumbler.SPEC, period=0)


def test_machine_failures_without_period_are_emergencies() -> None:
    runner = Runner(Reacting, Parameters.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    runner.start()
    worker = runner.worker
    assert isinstance(worker, Reacting)
    wait_until(lambda: worker.restored and worker.machine.is_in("b"))
    assert worker.failed == ["on_enter_b"]
    worker.machine.send("on")
    assert runner.wait()
    assert worker.machine.ended
