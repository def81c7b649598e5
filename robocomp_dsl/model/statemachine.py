"""State machines of SMDSL, resolved."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.source import Span


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """One state; `inside` are the states within it, all active at once where it is `parallel`.

    Names are unique in a machine. `initial` and `final` tell its part among its siblings.
    """

    name: str
    span: Span
    initial: bool = False
    final: bool = False
    parallel: bool = False
    inside: tuple[State, ...] = ()
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Transition:
    """From one state to one other, by an event or by time (`after_s`), or by whichever is first."""

    source: str
    target: str
    event: str
    span: Span
    after_s: float | None = None
    doc: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class StateMachine:
    """One SMDSL file."""

    name: str
    path: Path
    span: Span
    states: tuple[State, ...]
    transitions: tuple[Transition, ...]
    doc: str = ""
