"""Components for the tests of lock-step: a source, its clients, and how a client leaves."""

from __future__ import annotations

import random
import uuid
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from typing import Any

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ServedPort
from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors
from robocomp_dsl.runtime.machine import MachineSpec, StateSpec, TransitionSpec
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_interface import ClockProxy
from robocomp_dsl.runtime.time.clock_settings import parse_clock
from robocomp_dsl.runtime.time.clock_source import ClockSource

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
    """Moves with seeded noise and publishes its position."""

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
    """Drives back and forth; its commands depend on the order of all messages."""

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
    """Records messages and positions; its period is no multiple of that of the source."""

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


class TimerOnly(Component):
    """A state machine with time transitions only."""

    SPEC = ComponentSpec(
        name="timer",
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


@contextmanager
def running(
    classes: list[type[Component]],
    middleware: str,
    *,
    limit: float = 10.0,
    more: str = "",
    monitors: Mapping[str, tuple[ConnectionMonitors, ...]] | None = None,
) -> Iterator[dict[str, Any]]:
    """The components by their names; the first is the source. `monitors` are by component."""
    domain = uuid.uuid4().hex
    names = "+".join(follower.SPEC.name for follower in classes[1:])
    with ExitStack() as ends:
        runners = {}
        for cls in classes:
            clock = f"lockstep,from=base,limit={limit}{more}"
            clock += f",with={names}" if cls is classes[0] else ""
            settings = RunSettings(
                domain=domain,
                middleware=middleware,
                clock=parse_clock(clock),
                monitors=(monitors or {}).get(cls.SPEC.name, ()),
            )
            runner = Runner(cls, Parameters(), settings)
            runner.start()
            ends.callback(stop, runner)
            runners[cls.SPEC.name] = runner
        yield runners


def stop(runner: Runner) -> None:
    runner.stop()
    runner.wait()


def disconnect(runner: Runner) -> None:
    """Disconnect without notice, as a killed process does."""
    runner.ports.close()
