"""Data of a state machine: constants that generated code contains and the runtime reads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StateSpec:
    """One state; `inside` are its substates, all active if it is `parallel`.

    `method` is the suffix of the worker's methods: `state_<method>`, `on_enter_<method>`,
    `on_exit_<method>`; empty: the name of the state.
    """

    name: str
    method: str = ""
    initial: bool = False
    final: bool = False
    parallel: bool = False
    inside: tuple[StateSpec, ...] = ()

    @property
    def suffix(self) -> str:
        """The suffix of its methods."""
        return self.method or self.name

    def walk(self) -> Iterator[StateSpec]:
        """The state and all nested states, outermost first."""
        yield self
        for state in self.inside:
            yield from state.walk()


@dataclass(frozen=True, slots=True)
class TransitionSpec:
    """A transition, taken on `event` or after `after` seconds, whichever is first."""

    source: str
    target: str
    event: str = ""
    after: float | None = None


@dataclass(frozen=True, slots=True)
class MachineSpec:
    """One state machine; if `scxml` is set, that document defines its behaviour.

    `events` are the further names that `Machine.send` accepts besides those of `transitions`.
    """

    name: str
    states: tuple[StateSpec, ...]
    transitions: tuple[TransitionSpec, ...] = ()
    events: tuple[str, ...] = ()
    scxml: str = ""

    def walk(self) -> Iterator[StateSpec]:
        """All states, outermost first."""
        for state in self.states:
            yield from state.walk()
