"""A state machine as blocks of a page: its diagram, states and transitions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.doc.nodes import (
    Block,
    Heading,
    Inlines,
    TableRow,
    data_table,
    inline_code,
    join_inlines,
    plain_text,
)
from robocomp_dsl.generate.doc.prose import flatten_doc, parse_prose
from robocomp_dsl.generate.doc.state_figure import state_figure
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def machine_blocks(machine: StateMachine, page: str) -> Iterator[Block]:
    """The blocks of a state machine in the page at the path `page`."""
    yield from parse_prose(machine.doc)
    yield state_figure(machine, f"{page}.states")
    head = ("state", "inside", "kind", "on entry", "on exit", "what it is")
    rows = [TableRow(_state(state, parent)) for state, parent in _walk_states(machine.states)]
    if rows:
        yield Heading(3, plain_text("All states"), "all-states")
    yield from data_table(f"States of {machine.name}", head, rows)
    if machine.transitions:
        yield Heading(3, plain_text("Transitions"), "transitions")
    moves = [TableRow(_transition(transition)) for transition in machine.transitions]
    head = ("from", "to", "event", "if", "does", "what it is")
    yield from data_table(f"Transitions of {machine.name}", head, moves)


def _walk_states(states: Iterable[State], parent: str = "") -> Iterator[tuple[State, str]]:
    for state in states:
        yield state, parent
        yield from _walk_states(state.substates, state.name)


def _state(state: State, parent: str) -> tuple[Inlines, ...]:
    marks = {
        "initial": state.initial,
        "end": state.final,
        "parallel": state.parallel,
        f"{state.history} history": bool(state.history),
    }
    message = ", ".join(word for word, applies in marks.items() if applies)
    acts = (_script(state.entry), _script(state.exit))
    return (
        inline_code(state.name),
        inline_code(parent),
        plain_text(message),
        *acts,
        flatten_doc(state.doc),
    )


def _transition(transition: Transition) -> tuple[Inlines, ...]:
    after = "" if transition.after_s is None else f"after {transition.after_s:g} s"
    between = " or " if transition.event and after else ""
    fired = (*inline_code(transition.event), *plain_text(f"{between}{after}"))
    targets = join_inlines(map(inline_code, transition.targets)) or plain_text("stays")
    acts = (_script(transition.cond), _script(transition.action))
    return inline_code(transition.source), targets, fired, *acts, flatten_doc(transition.doc)


def _script(written: str) -> Inlines:
    return inline_code(literals.printable(" ".join(written.split())))
