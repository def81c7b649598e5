"""A state machine as blocks of a page: its diagram, states and transitions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate.doc.state_figure import state_figure
from robocomp_dsl.generate.doc.types_shown import inline_doc
from robocomp_dsl.generate.doc.words import (
    Block,
    Heading,
    Row,
    Words,
    code,
    prose,
    table,
    text,
)
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def machine_blocks(machine: StateMachine, page: str) -> Iterator[Block]:
    """Everything about a machine, as part of the page at this path."""
    yield from prose(machine.doc)
    yield state_figure(machine, f"{page}.states")
    head = ("state", "inside", "kind", "what it is")
    rows = [Row(_state(one, around)) for one, around in _flat(machine.states)]
    if not rows:
        return
    yield Heading(3, text("All states"), "all-states")
    yield from table(f"States of {machine.name}", head, rows)
    if machine.transitions:
        yield Heading(3, text("Transitions"), "transitions")
    moves = [Row(_transition(one)) for one in machine.transitions]
    head = ("from", "to", "event", "what it is")
    yield from table(f"Transitions of {machine.name}", head, moves)


def _flat(states: Iterable[State], around: str = "") -> Iterator[tuple[State, str]]:
    for one in states:
        yield one, around
        yield from _flat(one.inside, one.name)


def _state(one: State, around: str) -> tuple[Words, ...]:
    marks = {"initial": one.initial, "end": one.final, "all inside it at once": one.parallel}
    said = ", ".join(word for word, given in marks.items() if given)
    return code(one.name), code(around), text(said), inline_doc(one.doc)


def _transition(one: Transition) -> tuple[Words, ...]:
    after = "" if one.after_s is None else f"after {one.after_s:g} s"
    between = " or " if one.event and after else ""
    fired = (*code(one.event), *text(f"{between}{after}"))
    return code(one.source), code(one.target), fired, inline_doc(one.doc)
