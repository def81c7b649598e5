"""State machines as workers use them: signals that are events, `start`, methods `sm_…`.

In: signals that the worker emits. Out: transitions. A component with a machine in SMDSL has that
of the runtime; one without has RoboComp's default machine, `initialize`, `compute`, `finalize`.
"""

from __future__ import annotations

from collections.abc import Callable

from robocomp_dsl.runtime.robocomp.event_loop import EventLoop
from robocomp_dsl.runtime.robocomp.signals import BoundSignal

DEFAULT_TRANSITIONS = (
    ("initialize", "compute"),
    ("compute", "compute"),
    ("compute", "finalize"),
)
DEFAULT_FINAL = "finalize"


class MachineSignal(BoundSignal):
    """A signal that is an event of a state machine; the event is sent after the current slot."""

    def __init__(self, loop: EventLoop, send: Callable[[], object]) -> None:
        super().__init__(loop)
        self._send = send

    def emit(self, *arguments: object) -> None:
        """Call the slots, and send the event."""
        super().emit(*arguments)
        self._loop.post(self._send)

    __call__ = emit


class MachineControl:
    """`self.<machine>` of a worker whose machine the runtime starts after `initialize`."""

    def start(self) -> None:
        """Does nothing: the machine starts after `__init__` and `setParams`."""


class DefaultMachine:
    """RoboComp's default machine. Each period of `self.timer` re-enters the state `compute`.

    `worker` has a method `sm_…` for each state, which is called when the state is entered.
    """

    def __init__(self, worker: object, loop: EventLoop) -> None:
        self._worker = worker
        self._loop = loop
        self._state: str | None = None
        self.signals = {
            f"t_{source}_to_{target}": MachineSignal(loop, self._sender(source, target))
            for source, target in DEFAULT_TRANSITIONS
        }

    def start(self) -> None:
        """Enter `initialize`, when the current slot has returned."""
        self._loop.post(lambda: self._enter(DEFAULT_TRANSITIONS[0][0]))

    def stop(self) -> None:
        """Take no more transitions until `start`."""
        self._state = None

    def isRunning(self) -> bool:
        """Whether it is in a state that is not final."""
        return self._state is not None

    def _sender(self, source: str, target: str) -> Callable[[], None]:
        def send() -> None:
            if self._state == source:
                self._enter(target)

        return send

    def _enter(self, state: str) -> None:
        self._state = None if state == DEFAULT_FINAL else state
        getattr(self._worker, f"sm_{state}")()
