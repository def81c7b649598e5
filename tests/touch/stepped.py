"""Components in one process that live by simulated time, as fast as they can, from test to test.

The one that makes the time is a `Stepped`: its world goes on only while a test says so, and when
`run` returns, all that was to happen until then has happened. Nothing depends on the wall's clock.
"""

from __future__ import annotations

import threading
import uuid
from collections.abc import Iterable
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

DEADLINE = 60.0
TICK = 0.02


class Stepped(Component):
    """Makes the time of all. `tick` is what it does in one of its periods."""

    def __init__(self) -> None:
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


class Stage:
    """One `Stepped` and those who follow it, in a domain of their own."""

    def __init__(
        self, source: type[Component], others: Iterable[tuple[type[Component], RunSettings, Any]]
    ) -> None:
        self.domain = uuid.uuid4().hex[:8]
        others = list(others)
        names = tuple(s.name or one.SPEC.name for one, s, _ in others)
        clock = ClockSettings("lockstep", source.SPEC.name, names)
        self.runners = [
            Runner(
                one,
                one.SPEC.parameters.load(None, said) if isinstance(said, tuple) else said,
                RunSettings(
                    name=s.name, domain=self.domain, middleware="inproc", wires=s.wires, clock=clock
                ),
            )
            for one, s, said in others
        ]
        mine = RunSettings(domain=self.domain, middleware="inproc", clock=clock)
        self.source = Runner(source, source.SPEC.parameters.load(), mine)
        host = Host("looker", self.domain, Execution(), Statistics())
        self._middleware = open_middleware("inproc", host)
        for one in (*self.runners, self.source):
            one.start()
        self._idle()

    @property
    def world(self) -> Any:
        return self.source.worker

    def worker(self, index: int = 0) -> Any:
        return self.runners[index].worker

    def proxy(self, kind: Any, component: str, port: str) -> Any:
        at = Endpoint(kind.INTERFACE, "looker", port, (component,))
        return kind(self._middleware.proxy(at))

    def run(self, seconds: float) -> None:
        """Let so much simulated time pass; all is at rest then."""
        ticks = round(seconds / TICK)
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
