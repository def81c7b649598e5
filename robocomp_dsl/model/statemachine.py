"""State machines of SMDSL and SCXML, resolved. What SMDSL cannot say has its default there."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class State(Record):
    """One state; `inside` are the states within it, all active at once where it is `parallel`.

    Names are unique in a machine. `initial` and `final` tell its part among its siblings; `start`
    are the states that are entered with it, one of those inside unless SCXML says otherwise.
    `history` ("shallow" or "deep") is no state, but a way to those that were active last; then
    `start` is where it leads at first. `entry` and `exit` are executable content, as written.
    """

    name: str
    span: Span
    initial: bool = False
    final: bool = False
    parallel: bool = False
    inside: tuple[State, ...] = ()
    doc: str = ""
    start: tuple[str, ...] = ()
    history: str = ""
    entry: str = ""
    exit: str = ""


class Transition(Record):
    """From one state to one other, by an event or by time (`after_s`), or by whichever is first.

    In SCXML `event` may list several, be a pattern, or be empty: then it is taken as soon as `cond`
    holds. `target` may be empty, so that only `action` happens, and `others` are entered with it,
    in other parallel states. `cond` and `action` are as written; `internal`: the source stays
    active.
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
        """All states that it enters."""
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

    def every_state(self) -> Iterator[State]:
        """The states and all inside them, outer ones first; histories are among them."""
        todo = list(reversed(self.states))
        while todo:
            one = todo.pop()
            yield one
            todo.extend(reversed(one.inside))
