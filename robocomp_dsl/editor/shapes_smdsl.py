"""State machines, states and events as a few lines of SMDSL.

In: objects of the model. Out: text.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.editor.names_smdsl import Event, StateInMachine
from robocomp_dsl.editor.shapes_block import block
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def _machine(one: StateMachine) -> str:
    ways = block("transitions", [way(each) for each in one.transitions])
    return block(one.name, [*_states(one.states), *([ways] if one.transitions else [])])


def _state(one: StateInMachine) -> str:
    state = one.state
    lines = [_declared(state)]
    if state.inside:
        head = f":{state.name}{' parallel' if state.parallel else ''}"
        lines.append(block(head, _states(state.inside)))
    lines += [way(each) for each in one.ways]
    return "\n".join(lines)


def _event(one: Event) -> str:
    return "\n".join([f"// event {one.name}", *(way(each) for each in one.ways)])


def way(one: Transition) -> str:
    """One transition; the event that has a name of its own is not repeated."""
    own = f"t_{one.source}_to_{one.target}"
    on = f" on {one.event}" if one.event not in ("", own) else ""
    after = "" if one.after_s is None else f" after {one.after_s:g} s"
    return f"{one.source} => {one.target}{on}{after};"


def _states(states: Sequence[State]) -> list[str]:
    between = [one.name for one in states if not (one.initial or one.final)]
    lines = [_declared(one) for one in states if one.initial]
    lines += [f"states {', '.join(between)};"] if between else []
    return lines + [_declared(one) for one in states if one.final]


def _declared(one: State) -> str:
    word = "initial_state" if one.initial else "end_state" if one.final else "states"
    return f"{word} {one.name};"


SHAPES: dict[type, Callable[[Any], str]] = {
    StateMachine: _machine,
    StateInMachine: _state,
    Event: _event,
}
