"""A state machine as data: the constant that generated code writes and the runtime reads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StateSpec:
    """One state; `inside` are those within it, all active at once where it is `parallel`.

    `method` is its part of the worker's methods: `state_<method>`, `on_enter_<method>`,
    `on_exit_<method>`; empty for the name itself.
    """

    name: str
    method: str = ""
    initial: bool = False
    final: bool = False
    parallel: bool = False
    inside: tuple[StateSpec, ...] = ()

    @property
    def suffix(self) -> str:
        """What its methods end in."""
        return self.method or self.name

    def walk(self) -> Iterator[StateSpec]:
        """Itself and all within it, outer ones first."""
        yield self
        for one in self.inside:
            yield from one.walk()


@dataclass(frozen=True, slots=True)
class TransitionSpec:
    """From one state to another, by an event, or `after` seconds, or by whichever is first."""

    source: str
    target: str
    event: str = ""
    after: float | None = None


@dataclass(frozen=True, slots=True)
class MachineSpec:
    """One machine. With `scxml`, the text of a document, that says how it moves.

    `events` are the names that `Machine.go` takes; those of `transitions` are among them.
    """

    name: str
    states: tuple[StateSpec, ...]
    transitions: tuple[TransitionSpec, ...] = ()
    events: tuple[str, ...] = ()
    scxml: str = ""

    def walk(self) -> Iterator[StateSpec]:
        """All states, outer ones first."""
        for one in self.states:
            yield from one.walk()
