"""A state machine as blocks of a page: its diagram, states and transitions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.prose import inline_doc, prose
from robocomp_dsl.generate.doc.state_figure import state_figure
from robocomp_dsl.generate.doc.words import (
    Block,
    Heading,
    Row,
    Words,
    code,
    joined,
    table,
    text,
)
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def machine_blocks(machine: StateMachine, page: str) -> Iterator[Block]:
    """Everything about a machine, as part of the page at this path."""
    yield from prose(machine.doc)
    yield state_figure(machine, f"{page}.states")
    head = ("state", "inside", "kind", "on entry", "on exit", "what it is")
    rows = [Row(_state(one, around)) for one, around in _flat(machine.states)]
    if rows:
        yield Heading(3, text("All states"), "all-states")
    yield from table(f"States of {machine.name}", head, rows)
    if machine.transitions:
        yield Heading(3, text("Transitions"), "transitions")
    moves = [Row(_transition(one)) for one in machine.transitions]
    head = ("from", "to", "event", "if", "does", "what it is")
    yield from table(f"Transitions of {machine.name}", head, moves)


def _flat(states: Iterable[State], around: str = "") -> Iterator[tuple[State, str]]:
    for one in states:
        yield one, around
        yield from _flat(one.inside, one.name)


def _state(one: State, around: str) -> tuple[Words, ...]:
    marks = {
        "initial": one.initial,
        "end": one.final,
        "all inside it at once": one.parallel,
        f"{one.history} history": bool(one.history),
    }
    said = ", ".join(word for word, given in marks.items() if given)
    acts = (_script(one.entry), _script(one.exit))
    return code(one.name), code(around), text(said), *acts, inline_doc(one.doc)


def _transition(one: Transition) -> tuple[Words, ...]:
    after = "" if one.after_s is None else f"after {one.after_s:g} s"
    between = " or " if one.event and after else ""
    fired = (*code(one.event), *text(f"{between}{after}"))
    targets = joined(map(code, one.targets)) or text("stays")
    acts = (_script(one.cond), _script(one.action))
    return code(one.source), targets, fired, *acts, inline_doc(one.doc)


def _script(written: str) -> Words:
    return code(literals.printable(" ".join(written.split())))
