"""Runs one component: connects its ports, lives its life, and brings it to an end.

In: the user's class, its parameters, `RunSettings`. Out: a component that others see, until `stop`.
The life is lived in a thread of its own, so that the main thread is free for signals even while
`compute` waits for an answer.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component import Component
from robocomp_dsl.runtime.component_interface import COMPONENT
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Interface
from robocomp_dsl.runtime.introspection import Introspection
from robocomp_dsl.runtime.lifecycle import Lifecycle, State
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Bound, Endpoint, Host, Qos
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.settings import RunSettings
from robocomp_dsl.runtime.spec import ServedPort
from robocomp_dsl.runtime.statistics import Statistics
from robocomp_dsl.runtime.timing import Owner, timing_of

PATIENCE_S = 1.5
"""What a component has, once it was told to stop, before calls that wait are interrupted."""
LAST_S = 2.0
"""And then, before it is left behind as it is."""

log = logging.getLogger("robocomp")


class Runner:
    """One running component."""

    def __init__(
        self,
        component: type[Component],
        params: Parameters,
        settings: RunSettings,
        clock: Clock | None = None,
    ) -> None:
        self.spec = component.SPEC
        self.settings = settings
        self.name = settings.whole_name(self.spec.name)
        self.params = params
        self.statistics = Statistics()
        self.execution = Execution(self.spec.threads)
        self.started = time.time()
        host = Host(
            self.name, settings.domain, self.execution, self.statistics, settings.listen_port
        )
        self.middleware_name = settings.middleware or self.spec.middleware
        self.middleware = open_middleware(self.middleware_name, host)
        owner = Owner(self.name, self.spec, self.fail, self._is_restless)
        self._timing = timing_of(settings.clock.under(settings.prefix), owner, self.middleware)
        self._failed = False
        self.worker = self._worker(component, clock or self._timing.clock)
        self.lifecycle = Lifecycle(
            self.worker,
            self.spec.period,
            self.worker.clock,
            self.execution,
            self.statistics,
            lambda state: self.middleware.announce(state.value),
        )
        if self.spec.machine:
            self.worker.machine = self.lifecycle.machine = Machine(
                self.spec.machine, self.worker, self.worker.clock, self.lifecycle.wake
            )
        self._asked: SimpleQueue[None] = SimpleQueue()
        self._ended = threading.Event()
        self._well = False

    def _worker(self, component: type[Component], clock: Clock) -> Component:
        """The user's object, with all that `Component` promises in its place."""
        worker = component()
        worker.name = self.name
        worker.params = self.params
        worker.config_file = self.settings.config
        worker.log = logging.getLogger(self.name)
        worker.clock = clock
        worker._runner = self
        for port in (*self.spec.requires, *self.spec.publishes):
            publishes = port in self.spec.publishes
            at = self._endpoint(port.name, port.proxy.INTERFACE, looks=not publishes)
            ports = self._timing.ports
            link = ports.advertise(at) if publishes else ports.proxy(at)
            setattr(worker, port.attribute, port.proxy(link))
        self.params.bind(worker)
        return worker

    def _endpoint(self, port: str, interface: Interface, *, looks: bool = False) -> Endpoint:
        """A port; one that `looks` for others keeps its name, and takes the names of theirs."""
        said = self.settings
        qos = said.qualities.get(port, Qos())
        name = port if looks else said.remaps.get(port, port)
        return Endpoint(interface, self.name, name, said.peers_of(port) if looks else (), qos)

    def _open(self) -> None:
        """Let others call."""
        for port in self.spec.implements:
            self._serve(port, self._timing.ports.serve)
        for port in self.spec.subscribes:
            self._serve(port, self._timing.ports.subscribe, looks=True)
        self._timing.open()

    def _serve(self, port: ServedPort, serve: Callable[..., Any], *, looks: bool = False) -> None:
        handlers: dict[str, Bound] = {
            operation: getattr(self.worker, method) for operation, method in port.methods.items()
        }
        serve(self._endpoint(port.name, port.interface, looks=looks), handlers, self.execution)

    def start(self) -> None:
        """Begin to live."""
        about = Introspection(self)
        at = self._endpoint("Component", COMPONENT)
        self.middleware.serve(at, about.handlers(), about.execution)
        threading.Thread(target=self._live, name=f"{self.name}.life", daemon=True).start()

    def _live(self) -> None:
        life = self.lifecycle
        try:
            self._well = life.begin()
            if self._well:
                self._open()
                self._say_hello()
                life.loop()
            self._well &= life.end()
            self._timing.close()
        finally:
            self._ended.set()
            self.stop()

    def _say_hello(self) -> None:
        period = f"every {self.spec.period} ms" if self.spec.period else "on events"
        through = f"{self.middleware_name}, domain {self.settings.domain}"
        log.info("running %s (%s)", period, through)

    def stop(self) -> None:
        """Bring it to an end; returns at once, from any thread or signal handler."""
        self._asked.put(None)

    def fail(self, reason: str) -> None:
        """Bring it to an end that is none in order."""
        log.error("%s", reason)
        self._failed = True
        self.stop()

    def _is_restless(self) -> bool:
        """Whether it has things to do at moments that handlers may bring about."""
        return bool(self.spec.machine) or not self.lifecycle.period_ms

    def wait(self) -> bool:
        """Until it has ended; tells whether all went well. Signals are handled meanwhile."""
        self._asked.get()
        self.lifecycle.stop()
        if not self._ended.wait(PATIENCE_S):
            self.middleware.interrupt()
        ended = self._ended.wait(LAST_S)
        if not ended:
            log.error("%s does not come to an end and is left behind", self.lifecycle.state.value)
        self.middleware.announce("")
        self.middleware.close()
        return ended and self._well and not self._failed

    @property
    def state(self) -> State:
        """Where it is in its life."""
        return self.lifecycle.state
