"""Actions that last, each in a thread of its own: begun, told to stop, waited for."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

from robocomp_dsl.hardware.plumbing.description import Phase


@dataclass(slots=True, eq=False)
class _Task:
    """What is done to a device, since which phase."""

    device: str
    phase: Phase
    stop: threading.Event = field(default_factory=threading.Event)


class Running:
    """The threads of one conductor; failures are counted by phase until they are taken."""

    def __init__(self) -> None:
        self._change = threading.Condition()
        self._tasks: list[_Task] = []
        self._failures: Counter[Phase] = Counter()

    def begin(self, device: str, phase: Phase, work: Callable[[threading.Event], bool]) -> None:
        """Let `work` run; it gets the event that tells it to end, and says whether it went well."""
        task = _Task(device, phase)

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

        with self._change:
            self._change.wait_for(lambda: over() or enough(), seconds)
            return over()

    def take_failures(self, phase: Phase) -> int:
        """How many have failed that began in `phase`, since this was asked last."""
        with self._change:
            return self._failures.pop(phase, 0)
