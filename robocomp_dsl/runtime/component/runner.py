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
from robocomp_dsl.runtime.component.hang_report import HangReport
from robocomp_dsl.runtime.component.hook_thread import HookThread, LifecycleThread
from robocomp_dsl.runtime.component.lifecycle import (
    SLOT_TIMEOUT_S,
    Lifecycle,
    LifecycleState,
)
from robocomp_dsl.runtime.component.own_interfaces import serve_own_interfaces
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.shown_parameters import ShownParameters
from robocomp_dsl.runtime.component.spec import CalledPort, ServedPort
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.component.supervision import Supervision, own_supervision
from robocomp_dsl.runtime.component.user_errors import add_user_folder, describe_error, log_error
from robocomp_dsl.runtime.component.watchdog import CallbackWatchdog
from robocomp_dsl.runtime.component.watched_callbacks import WatchedCallbacks, watchdog_limit
from robocomp_dsl.runtime.component.wiring import Wiring
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.monitor_setup import load_monitors, monitored_ports
from robocomp_dsl.runtime.connection.ports import ComponentContext, OperationCallable
from robocomp_dsl.runtime.errors import MiddlewareError, MonitorError, WindowError, WorkerError
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.time.clock_factory import ComponentHandle, create_clock

INTERRUPT_TIMEOUT_S = 1.0
"""Time after a stop request before waiting calls are interrupted."""
SHUTDOWN_TIMEOUT_S = 2.0
"""Further time for the current hook to return."""
FINALIZE_TIMEOUT_S = 1.5
"""Time for `finalize` beside a hook that did not return. The sum of the three is below the grace
period of rcdeploy."""
HANG_TIMEOUT_S = 0.3
"""Time for the current hook to return after the watchdog has found a hang."""

log = logging.getLogger("robocomp")


class Runner:
    """One running component."""

    def __init__(
        self,
        component: type[Component],
        params: Parameters,
        settings: RunSettings,
        clock: Clock | None = None,
        supervision: Supervision | None = None,
        hook_thread: HookThread | None = None,
    ) -> None:
        self.spec = component.SPEC
        self.name = settings.full_name(self.spec.name)
        self.wiring = Wiring(self.name, self.spec, settings)
        self.params = params
        self.statistics = Statistics()
        self._hook_thread = hook_thread or LifecycleThread(CallbackGroup(self.spec.threads))
        self.callback_group = self._hook_thread.callback_group
        self.started = time.time()
        self.abandoned = False
        self.hang: HangReport | None = None
        self._failed = False
        self._stop_requests: SimpleQueue[None] = SimpleQueue()
        self._ended = threading.Event()
        self.wiring.check_qos()
        self.monitors = load_monitors(self.spec, settings)
        host = ComponentContext(
            self.name,
            settings.domain,
            self.callback_group,
            self.statistics,
            settings.listen_port,
            fail=self.fail,
            unique_name=True,
            addresses=settings.visible_addresses(p.name for p in self.spec.implements),
            transport_settings=settings.transport_settings,
            parameters=ShownParameters(params, self.callback_group),
            call_hook=self._call_hook,
        )
        self.ports = open_ports(
            settings.middleware or self.spec.middleware,
            host,
            used={name for port in self.spec.ports for name in self.middlewares_of(port)},
            is_visible=bool(supervision and supervision.in_group),
        )
        try:
            self._create(component, clock, supervision)
        except BaseException:
            # Threads of the middleware would keep the process alive.
            self.ports.close()
            raise

    def _create(
        self, component: type[Component], clock: Clock | None, supervision: Supervision | None
    ) -> None:
        """The worker and what runs it."""
        settings = self.settings
        owner = ComponentHandle(self.name, self.spec, self.fail, self._is_event_driven)
        self._clock_binding = create_clock(
            settings.clock.with_prefix(settings.prefix), owner, self.ports
        )
        clock = clock or self._clock_binding.clock
        self._ports = monitored_ports(self._clock_binding.ports, self.monitors, clock)
        self.notifier, self._hangs, _ = supervision or own_supervision()
        self.worker = self._create_worker(component, clock)
        self.lifecycle = Lifecycle(
            self.worker,
            self.spec.period,
            self.worker.clock,
            self._hook_thread,
            self.statistics,
            self._publish_state,
        )
        self.worker._lifecycle = self.lifecycle
        if self.spec.machine:
            self.worker.machine = self.lifecycle.machine = Machine(
                self.spec.machine, self.worker, self.worker.clock, self.lifecycle.wake
            )
        self._succeeded = False
        self._thread = threading.Thread(
            target=self._run, name=f"{self.name}.lifecycle", daemon=True
        )
        self.watchdog = self._create_watchdog()

    def _create_watchdog(self) -> CallbackWatchdog | None:
        configured = self.settings.watchdog
        limit = self.spec.watchdog if configured is None else configured
        limit = watchdog_limit(limit, self.notifier.watchdog_s)
        if not limit:
            return None
        watched = WatchedCallbacks(self.name, self.lifecycle, self._hook_thread, self._thread)
        group = self.callback_group
        return CallbackWatchdog(limit, group, watched.activity_of, self._on_hang, self._on_beat)

    def _call_hook(self, hook: str, *arguments: object) -> None:
        """Call a hook of the user's class for an event of a connection."""
        getattr(self.worker, hook)(*arguments)

    def _on_beat(self, seconds: float) -> None:
        self._hangs.beat(seconds)
        if seconds:
            self.notifier.ping()

    def _publish_state(self, state: LifecycleState) -> None:
        self.ports.publish_state(state.value)
        self.notifier.state_changed(state.value, self.lifecycle.reason)

    def _create_worker(self, component: type[Component], clock: Clock) -> Component:
        """The user's object, with the attributes that `Component` declares."""
        add_user_folder(component)
        try:
            worker = component()
        except (MiddlewareError, MonitorError, WindowError):
            raise
        except Exception as error:
            raise WorkerError(component.__name__) from error
        worker.name = self.name
        worker.params = self.params
        worker.config_file = self.settings.config
        worker.log = logging.getLogger(self.name)
        worker.clock = clock
        worker._request_stop = self.stop
        for port in (*self.spec.requires, *self.spec.publishes):
            publishes = port in self.spec.publishes
            at = self.wiring.endpoint(port)
            link = self._ports.advertise(at) if publishes else self._ports.proxy(at)
            setattr(worker, port.attribute, port.proxy(link))
        self.params.bind(worker)
        return worker

    @property
    def settings(self) -> RunSettings:
        """The settings in force; connections may change while the component runs."""
        return self.wiring.settings

    def middlewares_of(self, port: ServedPort | CalledPort) -> tuple[str, ...]:
        """The middlewares of a port, in order of preference."""
        return self.wiring.middlewares_of(port)

    def _open(self) -> None:
        """Serve and subscribe all ports."""
        for port in self.spec.implements:
            self._serve(port, self._ports.serve)
        for port in self.spec.subscribes:
            self._serve(port, self._ports.subscribe)
        self._clock_binding.open()

    def _serve(self, port: ServedPort, serve: Callable[..., Any]) -> None:
        handlers: dict[str, OperationCallable] = {
            operation: getattr(self.worker, method) for operation, method in port.methods.items()
        }
        with self.wiring.lock:
            serve(self.wiring.endpoint(port), handlers, self.callback_group)
            self.wiring.mark_open(port)

    def start(self) -> None:
        """Serve the interfaces of every component, and start the lifecycle thread."""
        serve_own_interfaces(self)
        self._thread.start()
        if self.watchdog:
            self.watchdog.start()

    def _run(self) -> None:
        """The thread of the lifecycle: whatever ends it, `finalize` runs and the component ends."""
        life = self.lifecycle
        try:
            try:
                self._succeeded = life.initialize()
                if self._succeeded:
                    self._open()
                    self._log_started()
                    life.loop()
            except BaseException as error:
                self._on_fatal_error(error)
            if self.watchdog:
                self.watchdog.stop()
            self._succeeded &= life.finalize(0.0 if self.hang else SLOT_TIMEOUT_S)
            self._clock_binding.close()
        except BaseException as error:
            self._on_fatal_error(error)
        finally:
            self._ended.set()
            self.stop()

    def _on_fatal_error(self, error: BaseException) -> None:
        """End the component as failed: an error that is no emergency left the lifecycle."""
        hint = "; to end a component normally, call self.quit()"
        message = (
            f"{self.lifecycle.state.value} failed for good: {describe_error(error)}"
            f"{hint if isinstance(error, SystemExit) else ''}"
        )
        log_error(message, error)
        self._end_as_failed()

    def _log_started(self) -> None:
        period = f"every {self.spec.period} ms" if self.spec.period else "on events"
        used = dict.fromkeys(name for port in self.spec.ports for name in self.middlewares_of(port))
        middlewares = ", ".join(used) or self.ports.presence.house
        log.info("running %s (%s, domain %s)", period, middlewares, self.settings.domain)

    def stop(self) -> None:
        """Request a stop; returns immediately, from any thread or signal handler."""
        self._stop_requests.put(None)

    def fail(self, reason: str) -> None:
        """Stop the component as failed."""
        log.error("%s", reason)
        self._end_as_failed()

    def _end_as_failed(self) -> None:
        self._failed = True
        self.stop()

    def _is_event_driven(self) -> bool:
        """Whether handlers can cause work between periods: a state machine, or no period."""
        return bool(self.spec.machine) or not self.lifecycle.period_ms

    def wait(self) -> bool:
        """Wait for the end; returns whether it stopped normally. Signals are handled meanwhile.

        `abandoned` is set if a hook did not return; its thread still runs.
        """
        self._stop_requests.get()
        self.lifecycle.stop()
        if self.hang or not self._ended.wait(INTERRUPT_TIMEOUT_S):
            self.ports.interrupt()
        timeout = HANG_TIMEOUT_S if self.hang else SHUTDOWN_TIMEOUT_S
        if not self._ended.wait(timeout):
            self._abandon_hook(timeout)
        if self.watchdog:
            self.watchdog.stop()
        self.ports.publish_state("")
        self.ports.close()
        if self.monitors:
            self.monitors.destroy()
        if self.lifecycle.exit_code is not None:
            return self.lifecycle.exit_code == 0 and not self._failed
        ended = not self.abandoned or (self.lifecycle.may_block and not self.hang)
        return ended and self._succeeded and not self._failed

    def _abandon_hook(self, timeout: float) -> None:
        """Call `finalize` beside the hook that did not return within `timeout` s."""
        self.abandoned = True
        self._hook_thread.abandon()
        life = self.lifecycle
        level = logging.INFO if life.may_block and not self.hang else logging.ERROR
        log.log(level, "%s did not return within %g s; exiting anyway", life.state.value, timeout)
        threading.Thread(
            target=life.finalize, args=(0.0,), name=f"{self.name}.finalize", daemon=True
        ).start()
        if not life.finalized.wait(FINALIZE_TIMEOUT_S):
            log.error("finalize did not return within %g s", FINALIZE_TIMEOUT_S)

    def _on_hang(self, report: HangReport) -> None:
        """End the component; `finalize` runs beside the thread that hangs."""
        self.hang, self.abandoned = report, True
        self._hook_thread.abandon()
        self._hangs.report(report)
        stack = "\n".join(report.stack)
        self.fail(f"watchdog: {report.summary()}\n{stack}")

    @property
    def state(self) -> LifecycleState:
        """State of the lifecycle."""
        return self.lifecycle.state
