"""Signatures of state machines, states and events in SMDSL.

In: objects of the model. Out: text.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from robocomp_dsl.language_server.signatures.signatures_block import format_block
from robocomp_dsl.language_server.symbols.symbols_smdsl import EventInfo, StateInfo
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def _machine(machine: StateMachine) -> str:
    lines = _states(machine.states)
    if machine.transitions:
        lines.append(format_block("transitions", list(map(format_transition, machine.transitions))))
    return format_block(machine.name, lines)


def _state(info: StateInfo) -> str:
    state = info.state
    lines = [_declaration(state)]
    if state.substates:
        head = f":{state.name}{' parallel' if state.parallel else ''}"
        lines.append(format_block(head, _states(state.substates)))
    lines += map(format_transition, info.transitions)
    return "\n".join(lines)


def _event(info: EventInfo) -> str:
    return "\n".join([f"// event {info.name}", *map(format_transition, info.transitions)])


def format_transition(transition: Transition) -> str:
    """A transition as a statement, without the event if it has the default name."""
    default = f"t_{transition.source}_to_{transition.target}"
    on = f" on {transition.event}" if transition.event not in ("", default) else ""
    after = "" if transition.after_s is None else f" after {transition.after_s:g} s"
    return f"{transition.source} => {transition.target}{on}{after};"


def _states(states: Sequence[State]) -> list[str]:
    names = [state.name for state in states if not (state.initial or state.final)]
    lines = [_declaration(state) for state in states if state.initial]
    lines += [f"states {', '.join(names)};"] if names else []
    return lines + [_declaration(state) for state in states if state.final]


def _declaration(state: State) -> str:
    keyword = "initial_state" if state.initial else "end_state" if state.final else "states"
    return f"{keyword} {state.name};"


SIGNATURES: dict[type, Callable[[Any], str]] = {
    StateMachine: _machine,
    StateInfo: _state,
    EventInfo: _event,
}
