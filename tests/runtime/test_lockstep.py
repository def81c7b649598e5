"""Lock-step: components that compute at different periods, over each middleware, twice over."""

from __future__ import annotations

import logging
import random
import threading
import time
import uuid
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ServedPort
from robocomp_dsl.runtime.machine import MachineSpec, StateSpec, TransitionSpec
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_interface import ClockProxy
from robocomp_dsl.runtime.time.clock_settings import parse_clock
from robocomp_dsl.runtime.time.clock_source import ClockSource

DEADLINE = 120.0
DRIVE = rt.Interface(
    "Test::Drive",
    rt.Operation("where", returns=rt.Double),
    rt.Operation("go", rt.Pattern.COMMAND, inputs={"speed": rt.Double}),
)
SEEN = rt.Interface("Test::Seen", rt.Operation("seen", rt.Pattern.PUBLISH, inputs={"x": rt.Double}))


class DriveProxy(rt.Proxy):
    INTERFACE = DRIVE

    def where(self) -> float:
        return self._call("where")

    def go(self, speed: float) -> None:
        self._call("go", speed)


class SeenProxy(rt.Proxy):
    INTERFACE = SEEN

    def seen(self, x: float) -> None:
        self._call("seen", x)


class Base(Component):
    """Moves with noise from a seed, and tells where it is."""

    SPEC = ComponentSpec(
        name="base",
        period=10,
        implements=(ServedPort("Drive", DRIVE, {"where": "where", "go": "go"}),),
        publishes=(
            CalledPort("Clock", ClockProxy, "clock_proxy"),
            CalledPort("Seen", SeenProxy, "seen_proxy"),
        ),
    )
    end = 2.0
    seen_proxy: SeenProxy

    def initialize(self) -> None:
        assert isinstance(self.clock, ClockSource)
        self.source = self.clock
        self.source.set_speed(0)
        self.noise = random.Random(7)
        self.x = self.speed = 0.0
        self.commands = 0

    def compute(self) -> None:
        self.x += self.speed * 0.01 + self.noise.gauss(0, 0.001)
        self.seen_proxy.seen(self.x)
        if self.clock.now() >= self.end:
            self.source.pause()

    def where(self) -> float:
        return self.x + self.noise.gauss(0, 0.01)

    def go(self, speed: float) -> None:
        self.speed = speed
        self.commands += 1


class Driver(Component):
    """Drives to and fro; what it sees depends on the order of everything."""

    SPEC = ComponentSpec(
        name="driver",
        period=25,
        requires=(CalledPort("Drive", DriveProxy, "drive_proxy"),),
        subscribes=(ServedPort("Seen", SEEN, {"seen": "seen"}),),
    )
    drive_proxy: DriveProxy
    heard = 0.0

    def compute(self) -> None:
        x = self.drive_proxy.where()
        self.drive_proxy.go(0.4 - x - self.heard / 7)

    def seen(self, x: float) -> None:
        self.heard += x


class Recorder(Component):
    """Writes down what comes, and by itself at a period that is no multiple of the source's."""

    SPEC = ComponentSpec(
        name="recorder",
        period=17,
        requires=(CalledPort("Drive", DriveProxy, "drive_proxy"),),
        subscribes=(ServedPort("Seen", SEEN, {"seen": "seen"}),),
    )
    drive_proxy: DriveProxy

    def initialize(self) -> None:
        self.lines: list[str] = []

    def compute(self) -> None:
        self.lines.append(f"{self.clock.now()!r} is {self.drive_proxy.where()!r}")

    def seen(self, x: float) -> None:
        self.lines.append(f"{self.clock.now()!r} saw {x!r}")


class Napper(Component):
    """Moved by timers alone."""

    SPEC = ComponentSpec(
        name="napper",
        period=0,
        machine=MachineSpec(
            "nap",
            (StateSpec("asleep", initial=True), StateSpec("awake")),
            (
                TransitionSpec("asleep", "awake", after=0.313),
                TransitionSpec("awake", "asleep", after=0.1),
            ),
        ),
    )

    def __init__(self) -> None:
        self.woken: list[float] = []

    def on_enter_awake(self) -> None:
        self.woken.append(self.clock.now())


@pytest.fixture(params=["inproc", "zenoh"])
def middleware(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@contextmanager
def running(
    kinds: list[type[Component]], middleware: str, *, limit: float = 10.0, more: str = ""
) -> Iterator[dict[str, Any]]:
    """The components by their names; the first is the source."""
    domain = uuid.uuid4().hex
    names = "+".join(follower.SPEC.name for follower in kinds[1:])
    with ExitStack() as ends:
        runners = {}
        for kind in kinds:
            clock = f"lockstep,from=base,limit={limit}{more}"
            clock += f",with={names}" if kind is kinds[0] else ""
            settings = RunSettings(domain=domain, middleware=middleware, clock=parse_clock(clock))
            runner = Runner(kind, Parameters(), settings)
            runner.start()
            ends.callback(end, runner)
            runners[kind.SPEC.name] = runner
        yield runners


def end(runner: Runner) -> None:
    runner.stop()
    runner.wait()


def until(condition: Callable[[], Any], what: str) -> None:
    deadline = time.monotonic() + DEADLINE
    turn = threading.Event()
    while not condition():
        assert time.monotonic() < deadline, f"{what} did not come to pass"
        turn.wait(0.005)


def record(middleware: str, order: list[type[Component]]) -> str:
    with running([Base, *order], middleware) as them:
        base = them["base"].worker
        until(
            lambda: them["base"].state is LifecycleState.COMPUTE and base.source.paused, "the end"
        )
        until(lambda: base.commands == 81, "what is due at the end")
        return "\n".join(them["recorder"].worker.lines)


def test_two_runs_are_the_same_to_the_bit(middleware: str) -> None:
    first = record(middleware, [Driver, Recorder])
    assert record(middleware, [Recorder, Driver]) == first
    lines = first.splitlines()
    assert len(lines) == 201 + 118
    # each at its own time, the source first
    assert [line.split(" ")[:2] for line in lines[:5]] == [
        ["0.0", "saw"],
        ["0.0", "is"],
        ["0.01", "saw"],
        ["0.017", "is"],
        ["0.02", "saw"],
    ]


def test_timers_keep_their_moments(middleware: str) -> None:
    with running([Base, Napper], middleware) as them:
        base = them["base"].worker
        until(
            lambda: them["base"].state is LifecycleState.COMPUTE and base.source.paused, "the end"
        )
        assert them["napper"].worker.woken == [0.313, 0.726, 1.139, 1.552, 1.965]


def test_a_reset_is_the_beginning_again(middleware: str) -> None:
    class Short(Recorder):
        pass

    with running([Base, Short], middleware) as them:
        base, lines = them["base"].worker, lambda: them["recorder"].worker.lines
        until(
            lambda: them["base"].state is LifecycleState.COMPUTE and base.source.paused, "the end"
        )
        seen = [line.split(" ")[0] for line in lines()]
        base.source.reset()
        base.source.resume()
        until(lambda: base.source.paused and base.source.epoch == 1, "the second end")
        assert [line.split(" ")[0] for line in lines()] == seen * 2


def die(runner: Runner) -> None:
    """As when the process is killed: it is gone, and has told nobody."""
    runner.middleware.close()


@pytest.mark.parametrize(
    ("how", "middleware", "message", "level"),
    [
        (end, "inproc", "recorder stopped; the others continue", logging.INFO),
        (end, "zenoh", "recorder stopped; the others continue", logging.INFO),
        (die, "inproc", "recorder timed out or disconnected at", logging.WARNING),
        (die, "zenoh", "recorder timed out or disconnected at", logging.WARNING),
    ],
)
def test_who_is_away_is_told_and_left_out(
    how: Callable[[Runner], None],
    middleware: str,
    message: str,
    level: int,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # Who has been there is not waited for as at the start.
    for module in ("inproc", "zenoh.client"):
        monkeypatch.setattr(
            f"robocomp_dsl.runtime.middleware.{module}.DISCOVERY_TIMEOUT_S", 3 * DEADLINE
        )
    with (
        caplog.at_level(logging.INFO),
        running([Base, Driver, Recorder], middleware) as them,
    ):
        base = them["base"].worker
        base.end = 1e9
        until(lambda: base.clock.now() > 0.2, "the first 0.2 s")
        how(them["recorder"])
        gone = base.clock.now()
        until(lambda: base.clock.now() > gone + 0.5, "half a second without it")
        records = [record for record in caplog.records if message in record.getMessage()]
        assert [record.levelno for record in records] == [level]
        commands = base.commands
        until(lambda: base.commands > commands + 5, "commands of the driver")


def test_who_was_started_again_unnoticed_is_lost_and_back(
    middleware: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.INFO), running([Base, Recorder], middleware) as them:
        base, before = them["base"].worker, them["recorder"]
        base.end = 0.5
        until(
            lambda: them["base"].state is LifecycleState.COMPUTE and base.source.paused, "the pause"
        )
        die(before)
        again = Runner(Recorder, Parameters(), before.settings)
        again.start()
        try:
            until(lambda: again.state is LifecycleState.COMPUTE, "its second life")
            base.end = 1e9
            base.source.resume()
            until(lambda: "recorder rejoined at" in caplog.text, "its return")
            assert "recorder timed out or disconnected at" in caplog.text
            until(lambda: any("saw" in line for line in again.worker.lines), "what others publish")
        finally:
            end(again)


class Stuck(Driver):
    """Does not come back from one compute until it is let go."""

    SPEC = ComponentSpec(name="stuck", period=25)
    let_go = threading.Event()
    computed = 0

    def compute(self) -> None:
        self.computed += 1
        if self.clock.now() >= 0.1 and not self.let_go.is_set():
            self.let_go.wait(DEADLINE)


def test_who_does_not_answer_is_left_out_until_it_does(
    caplog: pytest.LogCaptureFixture,
) -> None:
    Stuck.let_go.clear()
    with caplog.at_level(logging.INFO), running([Base, Driver, Stuck], "zenoh", limit=2.0) as them:
        base = them["base"].worker
        base.end = 1e9
        try:
            until(lambda: base.clock.now() > 0.5, "the time behind it")
            assert "stuck timed out or disconnected at 0.1 s" in caplog.text
        finally:
            Stuck.let_go.set()
        until(lambda: "stuck rejoined at" in caplog.text, "its return")
        computed = them["stuck"].worker.computed
        until(lambda: them["stuck"].worker.computed > computed + 3, "its computes")


def test_the_source_ends_with_the_first_that_is_lost(caplog: pytest.LogCaptureFixture) -> None:
    with running([Base, Driver, Recorder], "inproc", more=",lost=stop") as them:
        base = them["base"].worker
        base.end = 1e9
        until(lambda: base.clock.now() > 0.1, "the first 0.1 s")
        die(them["recorder"])
        ended: list[bool] = []
        threading.Thread(target=lambda: ended.append(them["base"].wait()), daemon=True).start()
        until(lambda: ended, "the end of the source")
        assert ended == [False]
        assert "recorder timed out or disconnected" in caplog.text
