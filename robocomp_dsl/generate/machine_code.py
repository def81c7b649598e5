"""The state machine of a component as Python source.

In: the machine that the CDSL file names. Out: `MachineCode`, plain data for the templates: the
constant of `generated/machine.py` and the methods of the states.
"""

from __future__ import annotations

import re

from robocomp_dsl.generate import layout, literals, names
from robocomp_dsl.generate.layout import BODY, Group, Item
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.record import Value

METHODS = {
    "state": "Every period while `{}` is active.",
    "on_enter": "`{}` is entered.",
    "on_exit": "`{}` is left.",
}
"""What a state may have in the worker, and when it is called."""


class StateMethod(Value):
    """One method of one state."""

    name: str
    state: State
    verb: str
    doc: str


class MachineCode(Value):
    """The machine; `source` is the name of its file, `scxml` its text where it is SCXML."""

    source: str
    scxml: tuple[str, ...]
    spec: str
    methods: tuple[StateMethod, ...]
    events: tuple[str, ...]

    @property
    def imports(self) -> str:
        """The names that the constant needs."""
        more = ", TransitionSpec" if "TransitionSpec(" in self.spec else ""
        return f"MachineSpec, StateSpec{more}"

    def of_verb(self, verb: str) -> tuple[StateMethod, ...]:
        """Those that are called in one way."""
        return tuple(m for m in self.methods if m.verb == verb)


def machine_code(machine: StateMachine) -> MachineCode:
    """Everything that the templates print of it."""
    states = [one for one in machine.every_state() if not one.history]
    suffixes = _suffixes(states)
    methods = tuple(
        StateMethod(f"{verb}_{suffixes[one]}", one, verb, _doc(one, text))
        for one in states
        for verb, text in METHODS.items()
    )
    events = tuple(dict.fromkeys(e for t in machine.transitions for e in t.event.split()))
    text = _scxml(machine)
    spec = _spec(machine, suffixes, events, has_text=bool(text))
    return MachineCode(literals.printable(machine.path.name), text, spec, methods, events)


def method_names(machine: StateMachine) -> set[str]:
    """What the methods of its states are called."""
    states = [one for one in machine.every_state() if not one.history]
    return {f"{verb}_{suffix}" for suffix in _suffixes(states).values() for verb in METHODS}


def _suffixes(states: list[State]) -> dict[State, str]:
    return dict(zip(states, names.unique([_word(s.name) for s in states]), strict=True))


def _word(name: str) -> str:
    return "".join(c if c.isalnum() or c == "_" else "_" for c in name)


def _doc(one: State, text: str) -> str:
    said = literals.sentence(one.doc)
    return literals.docstring(f"{text.format(one.name)} {said}".strip(), BODY)


def _scxml(machine: StateMachine) -> tuple[str, ...]:
    """The document as string literals, a line each."""
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
    made: list[Item] = [f"name={literals.quoted(machine.name)}"]
    states = [_state(s, suffixes) for s in machine.states if not s.history]
    made.append(layout.tuple_of(*states, head="states="))
    if has_text:
        made.append(layout.tuple_of(*map(literals.python_string, events), head="events="))
        made.append("scxml=SCXML")
    else:
        made.append(layout.tuple_of(*map(_transition, machine.transitions), head="transitions="))
    return layout.statement("MACHINE = ", layout.call("MachineSpec", *made))


def _state(one: State, suffixes: dict[State, str]) -> Group:
    given: list[Item] = [literals.quoted(one.name)]
    if suffixes[one] != one.name:
        given.append(f"method={literals.quoted(suffixes[one])}")
    given += [f"{key}=True" for key in ("initial", "final", "parallel") if getattr(one, key)]
    inside = [_state(s, suffixes) for s in one.inside if not s.history]
    if inside:
        given.append(layout.tuple_of(*inside, head="inside="))
    return layout.call("StateSpec", *given)


def _transition(one: Transition) -> Group:
    given: list[Item] = [literals.quoted(one.source), literals.quoted(one.target)]
    if one.event:
        given.append(literals.quoted(one.event))
    if one.after_s is not None:
        given.append(f"after={literals.python_value(float(one.after_s))}")
    return layout.call("TransitionSpec", *given)
