"""Runs components of one process in simulated time, as fast as possible, controlled by a test.

The clock source is a `SteppedClockSource`: time passes only while a test calls `run`, which returns
when every component has finished its cycles. No result depends on the wall clock.
"""

from __future__ import annotations

import threading
import uuid
from dataclasses import dataclass, replace
from typing import Any

from robocomp_dsl.runtime import Component
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.time.clock_settings import ClockSettings
from robocomp_dsl.runtime.time.clock_source import ClockSource

DEADLINE = 120.0
TICK = 0.02
NAMELESS = RunSettings()


class SteppedClockSource(Component):
    """Makes the time of all. `tick` is what it does in one of its periods."""

    def __init__(self) -> None:
        super().__init__()
        self.left = 0
        self.idle, self.resumed = threading.Event(), threading.Event()
        self.over = False

    def tick(self) -> None:
        raise NotImplementedError

    def initialize(self) -> None:
        assert isinstance(self.clock, ClockSource)
        self.clock.set_speed(0)

    def compute(self) -> None:
        group = self._lifecycle._callback_group
        while not self.left and not self.over:
            began = group.pause()
            self.idle.set()
            self.resumed.wait()
            self.resumed.clear()
            if began:
                group.resume(began)
        if not self.over:
            self.left -= 1
            self.tick()


@dataclass(frozen=True)
class ComponentSetup:
    """One component that takes part: its parameters as on a command line, its name and wires."""

    worker: type[Component]
    overrides: tuple[str, ...] = ()
    settings: RunSettings = NAMELESS


class LockstepHarness:
    """One `SteppedClockSource` and those who follow it, in a domain of their own."""

    def __init__(self, source: ComponentSetup, *others: ComponentSetup) -> None:
        self.domain = uuid.uuid4().hex[:8]
        names = tuple(member.settings.name or member.worker.SPEC.name for member in others)
        self._clock = ClockSettings("lockstep", source.worker.SPEC.name, names)
        self.runners = [self._runner(member) for member in others]
        self.source = self._runner(source)
        host = ComponentContext("test_client", self.domain, CallbackGroup(), Statistics())
        self._middleware = open_ports("inproc", host)
        for runner in (*self.runners, self.source):
            runner.start()
        self._idle()

    def _runner(self, member: ComponentSetup) -> Runner:
        params = member.worker.SPEC.parameters.load(None, member.overrides)
        settings = replace(
            member.settings, domain=self.domain, middleware="inproc", clock=self._clock
        )
        return Runner(member.worker, params, settings)

    @property
    def world(self) -> Any:
        return self.source.worker

    def worker(self, index: int = 0) -> Any:
        return self.runners[index].worker

    def proxy(self, kind: Any, component: str, port: str) -> Any:
        at = Endpoint(kind.INTERFACE, "test_client", port, (f"{component}.{port}",))
        return kind(self._middleware.proxy(at))

    def run(self, seconds: float) -> None:
        """Let so much simulated time pass; all is at rest then."""
        ticks = round(1000 * seconds / self.source.spec.period)
        self.world.idle.clear()
        self.world.left = ticks
        self.world.resumed.set()
        self._idle()

    def _idle(self) -> None:
        assert self.world.idle.wait(DEADLINE), "a component does not come to rest"

    def close(self) -> None:
        """The followers first: each tells the source that it leaves."""
        for runner in self.runners:
            runner.stop()
            runner.wait()
        self.world.over = True
        self.world.resumed.set()
        self.source.stop()
        self.source.wait()
        self._middleware.close()
