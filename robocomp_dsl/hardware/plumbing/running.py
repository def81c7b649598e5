"""Actions that last, each in a thread of its own: begun, told to stop, waited for.

Who follows a device looks at it now and then. By the wall clock that is when some time has passed;
in step it is when `beat` is called, which returns when all have looked and wait for the next one:
what they do depends on the time of the simulation alone.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from robocomp_dsl.hardware.plumbing.description import Phase


@dataclass(slots=True, eq=False)
class _Task:
    """What is done to a device, since which phase."""

    device: str
    phase: Phase
    stop: threading.Event


class _Stop(threading.Event):
    """Tells an action to end; who waits for it waits for the next look at the same time."""

    def __init__(self, running: Running) -> None:
        super().__init__()
        self._running = running

    def wait(self, timeout: float | None = None) -> bool:
        """Until the next look, at the latest after `timeout` s of the wall clock out of step."""
        if not self._running.pause(self):
            super().wait(timeout)
        return self.is_set()


class Running:
    """The threads of one conductor; failures are counted by phase until they are taken."""

    def __init__(self) -> None:
        self._change = threading.Condition()
        self._tasks: list[_Task] = []
        self._failures: Counter[Phase] = Counter()
        self._in_step = False
        self._beats = self._paused = self._leaders = 0
        self._awaited: list[Callable[[], bool]] = []

    def keep_step(self, on: bool) -> None:
        """Whether `beat` says when it is looked, or the wall clock."""
        with self._change:
            self._in_step, self._paused = on, 0
            self._beats += 1
            self._change.notify_all()

    def lead(self) -> None:
        """A thread is about to lead through a phase; it tells `rest` when it has."""
        with self._change:
            self._leaders += 1

    def rest(self) -> None:
        """The phase is over."""
        with self._change:
            self._leaders -= 1
            self._change.notify_all()

    def beat(self, patience: float) -> bool:
        """Let all look once, and wait until they have; False: it took more than `patience` s."""
        with self._change:
            self._beats, self._paused = self._beats + 1, 0
            self._change.notify_all()
            return self._change.wait_for(self._quiet, patience)

    def pause(self, stop: threading.Event) -> bool:
        """In step: wait for the next beat, or for `stop`. Out of step: False, at once."""
        with self._change:
            if not self._in_step:
                return False
            before, self._paused = self._beats, self._paused + 1
            self._change.notify_all()
            self._change.wait_for(lambda: self._beats != before or stop.is_set())
            if self._beats == before:
                self._paused -= 1
            return True

    def _quiet(self) -> bool:
        """Whether all wait: actions for the next beat, who leads for actions that go on."""
        if self._paused != len(self._tasks) or len(self._awaited) < self._leaders:
            return False
        return not any(over() for over in self._awaited)

    def begin(self, device: str, phase: Phase, work: Callable[[threading.Event], bool]) -> None:
        """Let `work` run; it gets the event that tells it to end, and says whether it went well."""
        task = _Task(device, phase, _Stop(self))

        def run() -> None:
            well = False
            try:
                well = work(task.stop)
            finally:
                with self._change:
                    self._tasks.remove(task)
                    self._failures[phase] += not well
                    self._change.notify_all()

        with self._change:
            self._tasks.append(task)
        threading.Thread(target=run, name=f"device {device}", daemon=True).start()

    def stop(self, device: str = "") -> None:
        """Tell what is done to `device`, or everything, to end."""
        with self._change:
            for task in self._tasks:
                if device in ("", task.device):
                    task.stop.set()
            self._change.notify_all()

    def changed(self) -> None:
        """Let those who wait look again whether they are still to wait."""
        with self._change:
            self._change.notify_all()

    def wait(
        self,
        enough: Callable[[], bool] = lambda: False,
        *,
        phase: Phase | None = None,
        seconds: float | None = None,
    ) -> bool:
        """Wait until nothing runs that began in `phase` (None: at any time); whether it is so.

        `enough()` and the end of `seconds` end it earlier.
        """

        def over() -> bool:
            return not any(phase in (None, task.phase) for task in self._tasks)

        def done() -> bool:
            return over() or enough()

        with self._change:
            self._awaited.append(done)
            self._change.notify_all()
            try:
                self._change.wait_for(done, seconds)
            finally:
                self._awaited.remove(done)
            return over()

    def take_failures(self, phase: Phase) -> int:
        """How many have failed that began in `phase`, since this was asked last."""
        with self._change:
            return self._failures.pop(phase, 0)
