"""A state machine, its worker and its clock."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

from robocomp_dsl.runtime.machine import (
    Machine,
    MachineSpec,
    StateSpec,
    TransitionSpec,
)

GAME = MachineSpec(
    "game",
    (
        StateSpec("waiting", initial=True),
        StateSpec(
            "playing",
            parallel=True,
            inside=(
                StateSpec("music", inside=(StateSpec("loud", initial=True), StateSpec("soft"))),
                StateSpec("moves"),
            ),
        ),
        StateSpec("paused"),
        StateSpec("over", final=True),
    ),
    (
        TransitionSpec("waiting", "playing", "start"),
        TransitionSpec("loud", "soft", "hush"),
        TransitionSpec("playing", "paused", "pause", after=60.0),
        TransitionSpec("paused", "playing", "start"),
        TransitionSpec("paused", "over", after=10.0),
    ),
)


@dataclass
class ManualClock:
    """A clock that a test turns."""

    moment: float = 0.0

    def now(self) -> float:
        return self.moment

    def wait_until(self, moment: float | None, wake: threading.Event) -> None:
        raise NotImplementedError


@dataclass
class Worker:
    """Writes down what is called."""

    calls: list[str] = field(default_factory=list)
    machine: Machine | None = None

    def __getattr__(self, name: str) -> object:
        if name.startswith(("state_", "on_enter_", "on_exit_")):
            return lambda: self.calls.append(name)
        raise AttributeError(name)


def build_machine(spec: MachineSpec, worker: object, clock: ManualClock) -> Machine:
    machine = Machine(spec, worker, clock, lambda: None)
    machine.start()
    return machine
