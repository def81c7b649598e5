"""The life of a component: Initialize, Compute, Emergency and back, Finalize.

In: the hooks of the user's class, a clock, the token. Out: calls of the hooks, in order, until it
is stopped. A `compute` that fails brings the component into Emergency. There, once a period,
`emergency` and `restore` are called and `compute` is tried again; when all went well the component
is back in Compute. An emergency that the user's code declared lasts until it ends it. One is also
that nobody tells the time; it lasts until somebody does.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from enum import StrEnum
from typing import Protocol

from robocomp_dsl.runtime.clock import DIGITS, NANO, TIMELESS, Clock, Wake
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.middleware.calling import describe
from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.runtime.statistics import Statistics

log = logging.getLogger("robocomp")
RETRY_MS = 500
"""Period of the attempts to leave an emergency of a component that has no period of its own."""


class State(StrEnum):
    """Where a component is in its life."""

    INITIALIZE = "initialize"
    COMPUTE = "compute"
    EMERGENCY = "emergency"
    RESTORE = "restore"
    FINALIZE = "finalize"


class Hooks(Protocol):
    """What a component does in its states."""

    def initialize(self) -> None:
        """Once, before anything else."""

    def compute(self) -> None:
        """Every period."""

    def emergency(self) -> None:
        """Every period of an emergency."""

    def restore(self) -> None:
        """Before leaving an emergency."""

    def finalize(self) -> None:
        """Once, at the end."""


class Lifecycle:
    """Runs one component. `announce` is told every state."""

    def __init__(
        self,
        hooks: Hooks,
        period_ms: int,
        clock: Clock,
        execution: Execution,
        statistics: Statistics,
        announce: Callable[[State], None],
    ) -> None:
        self._hooks = hooks
        self.period_ms = period_ms
        self._clock = clock
        self._execution = execution
        self._statistics = statistics
        self._announce = announce
        self.machine: Machine | None = None
        self._wake = Wake()
        self._stopping = threading.Event()
        self.state = State.INITIALIZE
        self.reason = ""
        self._declared = False
        self._told: dict[str, float] = {}

    def begin(self) -> bool:
        """Initialize; whether that went well."""
        self._become(State.INITIALIZE)
        if not self._tried(self._hooks.initialize, "initialize"):
            return False
        return self.machine is None or self._tried(self.machine.start, "the state machine")

    def loop(self) -> None:
        """Compute, until `stop`."""
        if not self._stopping.is_set():
            # What `initialize` declared is not forgotten.
            self._become(State.EMERGENCY if self._declared else State.COMPUTE)
            self._loop()

    def end(self) -> bool:
        """Finalize; whether that went well."""
        self._become(State.FINALIZE)
        return self._tried(self._hooks.finalize, "finalize")

    def stop(self) -> None:
        """End after what is being done now."""
        self._stopping.set()
        self._wake.end()

    def set_period(self, period_ms: int) -> None:
        """From now on another period; 0: only events."""
        self.period_ms = period_ms
        self._wake.set()

    def declare_emergency(self, reason: str) -> None:
        """Stop calling `compute` until `end_emergency`."""
        if not self._declared or self.reason != reason:
            log.warning("emergency: %s", reason)
        self._declared = True
        self._enter_emergency(reason)
        self._wake.set()

    def end_emergency(self) -> None:
        """Let the component restore itself and compute again."""
        self._declared = False
        self._wake.set()

    def _become(self, state: State) -> None:
        self.state = state
        self._announce(state)

    def _until_time_begins(self) -> None:
        """A simulated clock is one only when its source has told the time."""
        if self._clock.epoch >= 0:
            return
        while self._clock.epoch < 0 and not self._stopping.is_set():
            self._clock.wait_until(0.0, self._wake)
            if not self._stopping.is_set():
                self._wake.clear()
        if self.machine:
            self.machine.restart_timers()

    def _loop(self) -> None:
        self._until_time_begins()
        due, epoch = self._clock.now(), self._clock.epoch
        last = 0.0
        while not self._stopping.is_set():
            period = self._period()
            if period is not None:
                begun = time.perf_counter_ns()
                now = self._clock.now()
                if last:
                    self._statistics.periods.add(round((now - last) * NANO))
                last = now
                self._cycle()
                self._statistics.computes.add(time.perf_counter_ns() - begun)
            elif self.machine:
                self._attempt(self._move)
            due = self._next(due, period)
            self._clock.wait_until(due if period is not None else self._timer(), self._wake)
            if self._stopping.is_set():
                return
            if self._clock.epoch != epoch:
                epoch = self._clock.epoch
                due, last = self._clock.now(), 0.0
                if self.machine:
                    self.machine.restart_timers()
            if self._clock.silent:
                self._stand_still()
            if self._wake.is_set() or self._clock.silent:
                self._wake.clear()
                due, last = self._clock.now(), 0.0

    def _period(self) -> float | None:
        """Seconds until the next cycle after one; None: there is none."""
        if self.period_ms:
            return self.period_ms / 1000
        return RETRY_MS / 1000 if self.state is State.EMERGENCY else None

    def _next(self, due: float, period: float | None) -> float:
        """When the next cycle begins; cycles that were missed are left out."""
        now = self._clock.now()
        if period is None:
            return now
        due += period
        if due < now:
            self._statistics.overruns += 1
            # Keeps to the grid, so that a slow cycle does not shift all that follow.
            due += ((now - due) // period) * period
        return round(due, DIGITS)

    def _cycle(self) -> None:
        if self.state is State.COMPUTE:
            self._attempt(self._compute)
        else:
            self._attempt(self._recover)

    def _compute(self) -> None:
        self._move()
        if self.period_ms:
            self._hooks.compute()
            if self.machine:
                self.machine.beat()

    def _move(self) -> None:
        """Let the state machine do what its time has come for; with its end all ends."""
        if self.machine:
            self.machine.fire_due()
            if self.machine.ended:
                log.info("the state machine has come to its end")
                self.stop()

    def _timer(self) -> float | None:
        return self.machine.due() if self.machine else None

    def wake(self) -> None:
        """A timer has another moment than before; with a period it is looked at once a period."""
        if not self.period_ms:
            self._wake.set()

    def _recover(self) -> None:
        self._hooks.emergency()
        if self._declared or self._clock.silent:
            return
        self.state = State.RESTORE
        self._hooks.restore()
        self._compute()
        log.info("the emergency is over: %s", self.reason)
        self.reason = ""
        self._told.clear()
        self._become(State.COMPUTE)

    def _attempt(self, action: Callable[[], None]) -> None:
        try:
            with self._execution:
                action()
        except Exception as error:
            if self._stopping.is_set():
                return
            self._statistics.failures += 1
            self._tell(error)
            self._enter_emergency(describe(error))

    def _stand_still(self) -> None:
        if self.state is State.COMPUTE:
            log.warning("emergency: %s", TIMELESS)
            self._enter_emergency(TIMELESS)

    def _enter_emergency(self, reason: str) -> None:
        self.reason = reason
        if self.state is State.COMPUTE:
            self._become(State.EMERGENCY)
        # An attempt to leave the emergency is not worth telling everybody of.
        elif self.state is State.RESTORE:
            self.state = State.EMERGENCY

    def _tell(self, error: Exception) -> None:
        """What goes wrong every cycle is said every ten seconds."""
        said, now = describe(error), time.monotonic()
        if now - self._told.get(said, -100.0) > 10.0:
            self._told[said] = now
            log.error("compute failed, trying on: %s", said)
            log.debug("the whole trace", exc_info=error)

    def _tried(self, hook: Callable[[], None], name: str) -> bool:
        try:
            with self._execution:
                hook()
        except ConfigError as error:
            # Findings say where they are; the place that raised them is of no interest.
            log.error("%s", str(error).removeprefix("error: "))  # noqa: TRY400
            return False
        except Exception as error:
            log.error("%s failed: %s", name, describe(error))  # noqa: TRY400 - trace below
            log.debug("the whole trace", exc_info=error)
            return False
        return True
