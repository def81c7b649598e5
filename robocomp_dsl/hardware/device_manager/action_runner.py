"""Runs long actions on devices, each in a thread of its own.

An action polls its device. On the wall clock it polls periodically; in lock-step it polls once per
`step`, which returns when all actions have polled and wait for the next step: their effects then
depend on simulated time alone.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from robocomp_dsl.hardware.device_manager.description import Phase


@dataclass(slots=True, eq=False)
class _RunningAction:
    """An action on a device, and the phase in which it started."""

    device: str
    phase: Phase
    stop: threading.Event


class _StopEvent(threading.Event):
    """Asks an action to end; waiting for it also waits for the next step."""

    def __init__(self, running: ActionRunner) -> None:
        super().__init__()
        self._runner = running

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until the next step, or without lock-step for at most `timeout` s."""
        if not self._runner.await_step(self):
            super().wait(timeout)
        return self.is_set()


class ActionRunner:
    """The threads of one device manager; failures are counted by phase until they are taken."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._tasks: list[_RunningAction] = []
        self._failures: Counter[Phase] = Counter()
        self._lockstep = False
        self._steps = self._waiting = self._phases = 0
        self._awaited: list[Callable[[], bool]] = []

    def set_lockstep(self, on: bool) -> None:
        """Let actions poll on each `step`, or else on the wall clock."""
        with self._changed:
            self._lockstep, self._waiting = on, 0
            self._steps += 1
            self._changed.notify_all()

    def enter_phase(self) -> None:
        """Called when a thread starts a phase; it calls `leave_phase` at the end."""
        with self._changed:
            self._phases += 1

    def leave_phase(self) -> None:
        """Called when the thread has finished its phase."""
        with self._changed:
            self._phases -= 1
            self._changed.notify_all()

    def step(self, timeout: float) -> bool:
        """Let all actions poll once, and wait for them; False after `timeout` s."""
        with self._changed:
            self._steps, self._waiting = self._steps + 1, 0
            self._changed.notify_all()
            return self._changed.wait_for(self._all_waiting, timeout)

    def await_step(self, stop: threading.Event) -> bool:
        """In lock-step wait for the next step, or for `stop`; otherwise return False."""
        with self._changed:
            if not self._lockstep:
                return False
            before, self._waiting = self._steps, self._waiting + 1
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._steps != before or stop.is_set())
            if self._steps == before:
                self._waiting -= 1
            return True

    def _all_waiting(self) -> bool:
        """Whether all threads wait: actions for the next step, phases for running actions."""
        if self._waiting != len(self._tasks) or len(self._awaited) < self._phases:
            return False
        return not any(over() for over in self._awaited)

    def start_action(
        self, device: str, phase: Phase, work: Callable[[threading.Event], bool]
    ) -> None:
        """Run `work` in a thread; it gets its stop event, and returns whether it succeeded."""
        task = _RunningAction(device, phase, _StopEvent(self))

        def run() -> None:
            well = False
            try:
                well = work(task.stop)
            finally:
                with self._changed:
                    self._tasks.remove(task)
                    self._failures[phase] += not well
                    self._changed.notify_all()

        with self._changed:
            self._tasks.append(task)
        threading.Thread(target=run, name=f"device {device}", daemon=True).start()

    def stop(self, device: str = "") -> None:
        """Ask the actions on `device`, or all actions, to end."""
        with self._changed:
            for task in self._tasks:
                if device in ("", task.device):
                    task.stop.set()
            self._changed.notify_all()

    def notify(self) -> None:
        """Wake the waiting threads, so that they check their conditions."""
        with self._changed:
            self._changed.notify_all()

    def wait(
        self,
        cancelled: Callable[[], bool] = lambda: False,
        *,
        phase: Phase | None = None,
        seconds: float | None = None,
    ) -> bool:
        """Wait for all actions of `phase` (None: any phase); returns whether all have ended.

        `cancelled()` and the time-out of `seconds` end the wait earlier.
        """

        def over() -> bool:
            return not any(phase in (None, task.phase) for task in self._tasks)

        def done() -> bool:
            return over() or cancelled()

        with self._changed:
            self._awaited.append(done)
            self._changed.notify_all()
            try:
                self._changed.wait_for(done, seconds)
            finally:
                self._awaited.remove(done)
            return over()

    def take_failures(self, phase: Phase) -> int:
        """The number of failed actions of `phase` since the last call."""
        with self._changed:
            return self._failures.pop(phase, 0)
