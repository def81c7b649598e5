"""The lifecycle of a component: Initialize, Compute, Emergency, Restore, Finalize.

In: the hooks of the user's class, a clock, the callback group. Out: calls of the hooks, in order,
until it is stopped. A `compute` that raises brings the component into Emergency. There, once per
period, `emergency`, `restore` and `compute` are called; when all succeed the component is back in
Compute. An emergency that the user's code declared lasts until `end_emergency`. A stale simulated
clock is an emergency, too; it lasts until the clock source is back. An exception that is no
`Exception`, such as `SystemExit`, leaves `loop`: the runner ends the component as failed.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from enum import StrEnum
from functools import partial

from robocomp_dsl.runtime.clock import CLOCK_LOST, NANO, Clock, WakeEvent
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.hook_thread import HookThread
from robocomp_dsl.runtime.component.hooks import Hooks
from robocomp_dsl.runtime.component.period_schedule import PeriodSchedule
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.component.throttle import Throttle
from robocomp_dsl.runtime.component.user_errors import describe_error, log_error, log_failure
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.parameters import ConfigError

log = logging.getLogger("robocomp")
RETRY_MS = 500
"""Period of the attempts to leave an emergency, for components without a period."""
SLOT_TIMEOUT_S = 1.0
"""Time that `finalize` waits for a callback that is running."""


class LifecycleState(StrEnum):
    """State of a component's lifecycle."""

    INITIALIZE = "initialize"
    COMPUTE = "compute"
    EMERGENCY = "emergency"
    RESTORE = "restore"
    FINALIZE = "finalize"


class Lifecycle:
    """Runs one component; `publish_state` receives every state.

    `on_stop` are called at the request to stop, while a hook may still run; `stops_with_machine`
    says whether the component ends when its state machine has; `exit_code` is that of the process
    if user code chose it (`exit`); with `may_block` a hook that does not return is no failure.
    """

    def __init__(
        self,
        hooks: Hooks,
        period_ms: float,
        clock: Clock,
        hook_thread: HookThread,
        statistics: Statistics,
        publish_state: Callable[[LifecycleState], None],
    ) -> None:
        self._hooks = hooks
        self.period_ms = period_ms
        self._clock = clock
        self._hook_thread = hook_thread
        self._callback_group = hook_thread.callback_group
        self.statistics = statistics
        self._publish_state = publish_state
        self.machine: Machine | None = None
        self._wake = WakeEvent()
        self._stopping = threading.Event()
        self.state = LifecycleState.INITIALIZE
        self.reason = ""
        self._declared = False
        self._finalize_lock = threading.Lock()
        self.finalized = threading.Event()
        self.on_stop: list[Callable[[], None]] = []
        self.stops_with_machine = True
        self.exit_code: int | None = None
        self.may_block = False
        self._throttle = Throttle()
        self._schedule = PeriodSchedule(clock, statistics)

    def use_hooks(self, hooks: Hooks) -> None:
        """Call these hooks from now on; they and handlers no longer exclude each other."""
        self._hooks = hooks
        self._callback_group = CallbackGroup()

    def initialize(self) -> bool:
        """Initialize; returns whether it succeeded."""
        self._transition_to(LifecycleState.INITIALIZE)
        if not self._call_hook(self._hooks.initialize, "initialize"):
            return False
        return self.machine is None or self._call_hook(self.machine.start, "the state machine")

    def loop(self) -> None:
        """Compute, until `stop`."""
        if not self._stopping.is_set():
            # `initialize` may have declared an emergency.
            self._transition_to(
                LifecycleState.EMERGENCY if self._declared else LifecycleState.COMPUTE
            )
            self._loop()

    def finalize(self, slot_timeout_s: float = SLOT_TIMEOUT_S) -> bool:
        """Finalize; returns whether it succeeded. Only the first call has an effect.

        A callback that hangs may hold the callback group for ever: after `slot_timeout_s` the hook
        runs without it. `finalized` is set at the end.
        """
        if not self._finalize_lock.acquire(blocking=False):
            return True
        try:
            self._transition_to(LifecycleState.FINALIZE)
            return self._call_hook(self._hooks.finalize, "finalize", slot_timeout_s)
        finally:
            self.finalized.set()

    def stop(self) -> None:
        """Stop after the current hook."""
        self._stopping.set()
        self._wake.stop()
        for notify in self.on_stop:
            notify()

    def exit(self, code: int) -> None:
        """Stop as `stop` does; the process ends with `code`. The first call has an effect."""
        if self.exit_code is None:
            self.exit_code = code
        self.stop()

    def set_period(self, period_ms: float) -> None:
        """Change the period; 0: event-driven."""
        self.period_ms = period_ms
        if self.state is not LifecycleState.INITIALIZE:
            self._wake.set()

    def declare_emergency(self, reason: str) -> None:
        """Stop calling `compute` until `end_emergency`."""
        if not self._declared or self.reason != reason:
            log.warning("emergency: %s", reason)
        self._declared = True
        self._enter_emergency(reason)
        self._wake.set()

    def end_emergency(self) -> None:
        """Let the component restore and compute again."""
        self._declared = False
        self._wake.set()

    def _transition_to(self, state: LifecycleState) -> None:
        self.state = state
        self._publish_state(state)

    def _wait_for_clock(self) -> None:
        """Wait for the first tick of a simulated clock."""
        if self._clock.reset_count >= 0:
            return
        while self._clock.reset_count < 0 and not self._stopping.is_set():
            self._clock.wait_until(0.0, self._wake)
            if not self._stopping.is_set():
                self._wake.clear()
        if self.machine:
            self.machine.restart_timers()

    def _loop(self) -> None:
        self._wait_for_clock()
        due, epoch = self._clock.now(), self._clock.reset_count
        last = 0.0
        while not self._stopping.is_set():
            period = self._period()
            if period is not None:
                begun = time.perf_counter_ns()
                now = self._clock.now()
                if last:
                    self.statistics.periods.add(round((now - last) * NANO))
                last = now
                self._cycle()
                self.statistics.computes.add(time.perf_counter_ns() - begun)
            elif self.machine:
                self._run_guarded(self._advance_machine)
            due = self._schedule.next_due(due, period)
            self._clock.wait_until(due if period is not None else self._next_timer(), self._wake)
            if self._stopping.is_set():
                return
            if self._clock.reset_count != epoch:
                epoch = self._clock.reset_count
                due, last = self._clock.now(), 0.0
                if self.machine:
                    self.machine.restart_timers()
            if self._clock.is_stale:
                self._on_clock_lost()
            if self._wake.is_set() or self._clock.is_stale:
                self._wake.clear()
                due, last = self._clock.now(), 0.0

    def _period(self) -> float | None:
        """Seconds between two cycles; None: event-driven."""
        if self.period_ms:
            return self.period_ms / 1000
        return RETRY_MS / 1000 if self.state is LifecycleState.EMERGENCY else None

    def _cycle(self) -> None:
        if self.state is LifecycleState.COMPUTE:
            self._run_guarded(self._compute)
        else:
            self._run_guarded(self._recover)

    def _compute(self) -> None:
        self._advance_machine()
        if self.period_ms:
            self._hooks.compute()
            if self.machine:
                self.machine.tick()

    def _advance_machine(self) -> None:
        """Fire due timers of the state machine; stop the component when the machine has ended."""
        if self.machine:
            self.machine.fire_due()
            if self.machine.ended and self.stops_with_machine:
                log.info("the state machine reached its final state")
                self.stop()

    def _next_timer(self) -> float | None:
        return self.machine.next_due() if self.machine else None

    def wake(self) -> None:
        """A timer has changed; components with a period check timers once per period."""
        if not self.period_ms:
            self._wake.set()

    def _recover(self) -> None:
        self._hooks.emergency()
        if self._declared or self._clock.is_stale:
            return
        self.state = LifecycleState.RESTORE
        self._hooks.restore()
        self._compute()
        log.info("recovered from emergency: %s", self.reason)
        self.reason = ""
        self._throttle.clear()
        self._transition_to(LifecycleState.COMPUTE)

    def _run_guarded(self, action: Callable[[], None]) -> None:
        def run() -> None:
            with self._callback_group:
                action()

        try:
            self._hook_thread.call(run)
        except BaseException as error:
            if self._stopping.is_set():
                return
            if not isinstance(error, Exception):
                raise
            self.statistics.failures += 1
            self._log_throttled(error)
            self._enter_emergency(describe_error(error))

    def _on_clock_lost(self) -> None:
        if self.state is LifecycleState.COMPUTE:
            log.warning("emergency: %s", CLOCK_LOST)
            self._enter_emergency(CLOCK_LOST)

    def _enter_emergency(self, reason: str) -> None:
        self.reason = reason
        if self.state is LifecycleState.COMPUTE:
            self._transition_to(LifecycleState.EMERGENCY)
        # A failed attempt to leave the emergency is not published.
        elif self.state is LifecycleState.RESTORE:
            self.state = LifecycleState.EMERGENCY

    def _log_throttled(self, error: Exception) -> None:
        message = describe_error(error)
        if self._throttle.allows(message):
            log_error(f"compute failed, retrying: {message}", error)

    def _call_hook(
        self, hook: Callable[[], None], name: str, slot_timeout_s: float | None = None
    ) -> bool:
        return self._hook_thread.call(partial(self._run_hook, hook, name, slot_timeout_s))

    def _run_hook(self, hook: Callable[[], None], name: str, slot_timeout_s: float | None) -> bool:
        group = self._callback_group
        entered = group.enter(slot_timeout_s)
        try:
            hook()
        except ConfigError as error:
            # The findings contain their locations; the traceback adds nothing.
            log.error("%s", str(error).removeprefix("error: "))  # noqa: TRY400
            return False
        except BaseException as error:
            if self.exit_code is None or not isinstance(error, SystemExit):
                log_failure(name, error)
            return False
        finally:
            if entered:
                group.leave()
        return True
