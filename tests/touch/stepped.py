"""Components in one process that live by simulated time, as fast as they can, from test to test.

The one that makes the time is a `Stepped`: its world goes on only while a test says so, and when
`run` returns, all that was to happen until then has happened. Nothing depends on the wall's clock.
"""

from __future__ import annotations

import threading
import uuid
from dataclasses import dataclass, replace
from typing import Any

from robocomp_dsl.runtime import Component
from robocomp_dsl.runtime.clock_settings import ClockSettings
from robocomp_dsl.runtime.clock_source import ClockSource
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host
from robocomp_dsl.runtime.runner import Runner
from robocomp_dsl.runtime.settings import RunSettings
from robocomp_dsl.runtime.statistics import Statistics

DEADLINE = 120.0
TICK = 0.02
NAMELESS = RunSettings()


class Stepped(Component):
    """Makes the time of all. `tick` is what it does in one of its periods."""

    def __init__(self) -> None:
        super().__init__()
        self.left = 0
        self.idle, self.wanted = threading.Event(), threading.Event()
        self.over = False

    def tick(self) -> None:
        raise NotImplementedError

    def initialize(self) -> None:
        assert isinstance(self.clock, ClockSource)
        self.clock.set_speed(0)

    def compute(self) -> None:
        while not self.left and not self.over:
            paused = self._runner.execution.pause()
            self.idle.set()
            self.wanted.wait()
            self.wanted.clear()
            if paused:
                self._runner.execution.resume()
        if not self.over:
            self.left -= 1
            self.tick()


@dataclass(frozen=True)
class Cast:
    """One component that takes part: its parameters as on a command line, its name and wires."""

    worker: type[Component]
    said: tuple[str, ...] = ()
    settings: RunSettings = NAMELESS


class Stage:
    """One `Stepped` and those who follow it, in a domain of their own."""

    def __init__(self, source: Cast, *others: Cast) -> None:
        self.domain = uuid.uuid4().hex[:8]
        names = tuple(one.settings.name or one.worker.SPEC.name for one in others)
        self._clock = ClockSettings("lockstep", source.worker.SPEC.name, names)
        self.runners = [self._runner(one) for one in others]
        self.source = self._runner(source)
        host = Host("looker", self.domain, Execution(), Statistics())
        self._middleware = open_middleware("inproc", host)
        for one in (*self.runners, self.source):
            one.start()
        self._idle()

    def _runner(self, one: Cast) -> Runner:
        params = one.worker.SPEC.parameters.load(None, one.said)
        settings = replace(one.settings, domain=self.domain, middleware="inproc", clock=self._clock)
        return Runner(one.worker, params, settings)

    @property
    def world(self) -> Any:
        return self.source.worker

    def worker(self, index: int = 0) -> Any:
        return self.runners[index].worker

    def proxy(self, kind: Any, component: str, port: str) -> Any:
        at = Endpoint(kind.INTERFACE, "looker", port, (f"{component}.{port}",))
        return kind(self._middleware.proxy(at))

    def run(self, seconds: float) -> None:
        """Let so much simulated time pass; all is at rest then."""
        ticks = round(1000 * seconds / self.source.spec.period)
        self.world.idle.clear()
        self.world.left = ticks
        self.world.wanted.set()
        self._idle()

    def _idle(self) -> None:
        assert self.world.idle.wait(DEADLINE), "a component does not come to rest"

    def close(self) -> None:
        """The followers first: each tells the source that it leaves."""
        for one in self.runners:
            one.stop()
            one.wait()
        self.world.over = True
        self.world.wanted.set()
        self.source.stop()
        self.source.wait()
        self._middleware.close()
