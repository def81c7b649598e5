"""The state machine of a component as Python source.

In: the machine that the CDSL file names. Out: `MachineCode`, plain data for the templates: the
constant of `machine.py` and the methods of the states.
"""

from __future__ import annotations

import re

from robocomp_dsl.generate import literals, names
from robocomp_dsl.generate.python import layout
from robocomp_dsl.generate.python.layout import BODY, Brackets, Item
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.record import ValueRecord

METHODS = {
    "state": "Every period while `{}` is active.",
    "on_enter": "`{}` is entered.",
    "on_exit": "`{}` is left.",
}
"""The methods of a state in the worker, and when they are called."""


class StateMethod(ValueRecord):
    """One method of one state."""

    name: str
    state: State
    verb: str
    doc: str


class MachineCode(ValueRecord):
    """The machine; `source` is the name of its file, `scxml` its text where it is SCXML."""

    source: str
    scxml: tuple[str, ...]
    spec: str
    methods: tuple[StateMethod, ...]
    events: tuple[str, ...]

    @property
    def imports(self) -> str:
        """The names that the constant imports."""
        more = ", TransitionSpec" if "TransitionSpec(" in self.spec else ""
        return f"MachineSpec, StateSpec{more}"

    def of_verb(self, verb: str) -> tuple[StateMethod, ...]:
        """The methods with one verb."""
        return tuple(m for m in self.methods if m.verb == verb)


def machine_code(machine: StateMachine) -> MachineCode:
    """The data of both templates."""
    states = [state for state in machine.all_states() if not state.history]
    suffixes = _suffixes(states)
    methods = tuple(
        StateMethod(f"{verb}_{suffixes[state]}", state, verb, _doc(state, text))
        for state in states
        for verb, text in METHODS.items()
    )
    events = tuple(dict.fromkeys(e for t in machine.transitions for e in t.event.split()))
    text = _scxml(machine)
    spec = _spec(machine, suffixes, events, has_text=bool(text))
    return MachineCode(literals.printable(machine.path.name), text, spec, methods, events)


def method_names(machine: StateMachine) -> set[str]:
    """The names of the states' methods."""
    states = [state for state in machine.all_states() if not state.history]
    return {f"{verb}_{suffix}" for suffix in _suffixes(states).values() for verb in METHODS}


def _suffixes(states: list[State]) -> dict[State, str]:
    return dict(zip(states, names.unique([_word(s.name) for s in states]), strict=True))


def _word(name: str) -> str:
    return "".join(c if c.isalnum() or c == "_" else "_" for c in name)


def _doc(state: State, text: str) -> str:
    doc = literals.sentence(state.doc)
    return literals.docstring(f"{text.format(state.name)} {doc}".strip(), BODY)


def _scxml(machine: StateMachine) -> tuple[str, ...]:
    """The document as string literals, one per line."""
    if machine.path.suffix.lower() != ".scxml":
        return ()
    lines = re.sub(r"\r\n?", "\n", machine.span.source.text).split("\n")
    ended = [f"{line}\n" for line in lines[:-1]] + ([lines[-1]] if lines[-1] else [])
    return tuple(map(literals.python_string, ended))


def _spec(
    machine: StateMachine,
    suffixes: dict[State, str],
    events: tuple[str, ...],
    *,
    has_text: bool,
) -> str:
    arguments: list[Item] = [f"name={literals.quoted(machine.name)}"]
    states = [_state(s, suffixes) for s in machine.states if not s.history]
    arguments.append(layout.tuple_of(*states, head="states="))
    if has_text:
        arguments.append(layout.tuple_of(*map(literals.python_string, events), head="events="))
        arguments.append("scxml=SCXML")
    else:
        arguments.append(
            layout.tuple_of(*map(_transition, machine.transitions), head="transitions=")
        )
    return layout.statement("MACHINE = ", layout.call("MachineSpec", *arguments))


def _state(state: State, suffixes: dict[State, str]) -> Brackets:
    arguments: list[Item] = [literals.quoted(state.name)]
    if suffixes[state] != state.name:
        arguments.append(f"method={literals.quoted(suffixes[state])}")
    arguments += [f"{key}=True" for key in ("initial", "final", "parallel") if getattr(state, key)]
    inside = [_state(s, suffixes) for s in state.substates if not s.history]
    if inside:
        arguments.append(layout.tuple_of(*inside, head="inside="))
    return layout.call("StateSpec", *arguments)


def _transition(transition: Transition) -> Brackets:
    arguments: list[Item] = [literals.quoted(transition.source), literals.quoted(transition.target)]
    if transition.event:
        arguments.append(literals.quoted(transition.event))
    if transition.after_s is not None:
        arguments.append(f"after={literals.python_value(float(transition.after_s))}")
    return layout.call("TransitionSpec", *arguments)
