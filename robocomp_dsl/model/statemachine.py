"""State machines of SMDSL and SCXML, resolved. Fields without SMDSL syntax have defaults."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class State(Record):
    """One state with its `substates`, which are all active simultaneously if it is `parallel`.

    Names are unique in a machine. `initial` and `final` are relative to the siblings; `start` are
    the states entered with it, one substate unless SCXML specifies others. A state with `history`
    ("shallow" or "deep") is an SCXML history; `start` is then its default target. `entry` and
    `exit` are executable content, as written.
    """

    name: str
    span: Span
    initial: bool = False
    final: bool = False
    parallel: bool = False
    substates: tuple[State, ...] = ()
    doc: str = ""
    start: tuple[str, ...] = ()
    history: str = ""
    entry: str = ""
    exit: str = ""


class Transition(Record):
    """A transition, triggered by an event or by time (`after_s`), or by whichever comes first.

    In SCXML `event` may list several events, be a pattern, or be empty: then the transition is
    taken as soon as `cond` holds. `target` may be empty (only `action` is executed); `others` are
    targets in other parallel states. `cond` and `action` are as written; `internal`: the source
    stays active.
    """

    source: str
    target: str
    event: str
    span: Span
    after_s: float | None = None
    doc: str = ""
    others: tuple[str, ...] = ()
    cond: str = ""
    action: str = ""
    internal: bool = False

    @property
    def targets(self) -> tuple[str, ...]:
        """All target states."""
        return (self.target, *self.others) if self.target else ()


class StateMachine(Record):
    """One SMDSL or SCXML file.

    `start` are the states entered first; `language` of `cond` and actions, and `data`, the data
    model as written, are empty in SMDSL.
    """

    name: str
    path: Path
    span: Span
    states: tuple[State, ...]
    transitions: tuple[Transition, ...]
    doc: str = ""
    start: tuple[str, ...] = ()
    language: str = ""
    data: str = ""

    def all_states(self) -> Iterator[State]:
        """All states and substates, outer ones first, including histories."""
        todo = list(reversed(self.states))
        while todo:
            state = todo.pop()
            yield state
            todo.extend(reversed(state.substates))
