"""Runs one component: connects its ports, runs its lifecycle, and shuts it down.

In: the user's class, its parameters, `RunSettings`. Out: a component that serves and publishes
until `stop`. The lifecycle runs in its own thread, so the main thread can handle signals even while
`compute` waits for a reply.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.component.component_interface import COMPONENT
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.introspection import Introspection
from robocomp_dsl.runtime.component.lifecycle import Lifecycle, LifecycleState
from robocomp_dsl.runtime.component.sd_notify import SystemdNotifier
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import ServedPort
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.middleware.base import Endpoint, MiddlewareContext, OperationCallable, Qos
from robocomp_dsl.runtime.middleware.registry import open_middleware
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_factory import ComponentHandle, create_clock

INTERRUPT_TIMEOUT_S = 1.5
"""Time after a stop request before waiting calls are interrupted."""
SHUTDOWN_TIMEOUT_S = 2.0
"""Further time before the process exits without waiting for the current hook."""

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
        self.name = settings.full_name(self.spec.name)
        self.params = params
        self.statistics = Statistics()
        self.callback_group = CallbackGroup(self.spec.threads)
        self.started = time.time()
        host = MiddlewareContext(
            self.name, settings.domain, self.callback_group, self.statistics, settings.listen_port
        )
        self.middleware_name = settings.middleware or self.spec.middleware
        self.middleware = open_middleware(self.middleware_name, host)
        owner = ComponentHandle(self.name, self.spec, self.fail, self._is_event_driven)
        self._clock_binding = create_clock(
            settings.clock.with_prefix(settings.prefix), owner, self.middleware
        )
        self._failed = False
        self.notifier = SystemdNotifier()
        self.worker = self._create_worker(component, clock or self._clock_binding.clock)
        self.lifecycle = Lifecycle(
            self.worker,
            self.spec.period,
            self.worker.clock,
            self.callback_group,
            self.statistics,
            self._publish_state,
        )
        if self.spec.machine:
            self.worker.machine = self.lifecycle.machine = Machine(
                self.spec.machine, self.worker, self.worker.clock, self.lifecycle.wake
            )
        self._stop_requests: SimpleQueue[None] = SimpleQueue()
        self._ended = threading.Event()
        self._succeeded = False

    def _publish_state(self, state: LifecycleState) -> None:
        self.middleware.publish_state(state.value)
        in_emergency = state is LifecycleState.EMERGENCY
        self.notifier.state_changed(state.value, self.lifecycle.reason if in_emergency else "")

    def _create_worker(self, component: type[Component], clock: Clock) -> Component:
        """The user's object, with the attributes that `Component` declares."""
        worker = component()
        worker.name = self.name
        worker.params = self.params
        worker.config_file = self.settings.config
        worker.log = logging.getLogger(self.name)
        worker.clock = clock
        worker._runner = self
        for port in (*self.spec.requires, *self.spec.publishes):
            publishes = port in self.spec.publishes
            at = self._endpoint(port.name, port.proxy.INTERFACE, outgoing=not publishes)
            ports = self._clock_binding.ports
            link = ports.advertise(at) if publishes else ports.proxy(at)
            setattr(worker, port.attribute, port.proxy(link))
        self.params.bind(worker)
        return worker

    def _endpoint(self, port: str, interface: Interface, *, outgoing: bool = False) -> Endpoint:
        """The endpoint of a port; an outgoing port keeps its name, and a remap names its peers."""
        settings = self.settings
        qos = settings.qos.get(port, Qos())
        name = port if outgoing else settings.remaps.get(port, port)
        return Endpoint(
            interface, self.name, name, settings.peers_of(port) if outgoing else (), qos
        )

    def _open(self) -> None:
        """Serve and subscribe all ports."""
        for port in self.spec.implements:
            self._serve(port, self._clock_binding.ports.serve)
        for port in self.spec.subscribes:
            self._serve(port, self._clock_binding.ports.subscribe, outgoing=True)
        self._clock_binding.open()

    def _serve(
        self, port: ServedPort, serve: Callable[..., Any], *, outgoing: bool = False
    ) -> None:
        handlers: dict[str, OperationCallable] = {
            operation: getattr(self.worker, method) for operation, method in port.methods.items()
        }
        serve(
            self._endpoint(port.name, port.interface, outgoing=outgoing),
            handlers,
            self.callback_group,
        )

    def start(self) -> None:
        """Serve the interface `Component` and start the lifecycle thread."""
        introspection = Introspection(self)
        at = self._endpoint("Component", COMPONENT)
        self.middleware.serve(at, introspection.handlers(), introspection.callback_group)
        threading.Thread(target=self._run, name=f"{self.name}.lifecycle", daemon=True).start()

    def _run(self) -> None:
        life = self.lifecycle
        try:
            self._succeeded = life.initialize()
            if self._succeeded:
                self._open()
                self._log_started()
                life.loop()
            self._succeeded &= life.finalize()
            self._clock_binding.close()
        finally:
            self._ended.set()
            self.stop()

    def _log_started(self) -> None:
        period = f"every {self.spec.period} ms" if self.spec.period else "on events"
        transport = f"{self.middleware_name}, domain {self.settings.domain}"
        log.info("running %s (%s)", period, transport)

    def stop(self) -> None:
        """Request a stop; returns immediately, from any thread or signal handler."""
        self._stop_requests.put(None)

    def fail(self, reason: str) -> None:
        """Stop the component as failed."""
        log.error("%s", reason)
        self._failed = True
        self.stop()

    def _is_event_driven(self) -> bool:
        """Whether handlers can cause work between periods: a state machine, or no period."""
        return bool(self.spec.machine) or not self.lifecycle.period_ms

    def wait(self) -> bool:
        """Wait for the end; returns whether it stopped normally. Signals are handled meanwhile."""
        self._stop_requests.get()
        self.lifecycle.stop()
        if not self._ended.wait(INTERRUPT_TIMEOUT_S):
            self.middleware.interrupt()
        ended = self._ended.wait(SHUTDOWN_TIMEOUT_S)
        if not ended:
            state, timeout = self.lifecycle.state.value, SHUTDOWN_TIMEOUT_S
            log.error("%s did not return within %g s; exiting anyway", state, timeout)
        self.middleware.publish_state("")
        self.middleware.close()
        return ended and self._succeeded and not self._failed

    @property
    def state(self) -> LifecycleState:
        """State of the lifecycle."""
        return self.lifecycle.state
