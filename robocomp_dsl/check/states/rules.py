"""The rules for state machines of SMDSL and SCXML: RC704, RC705, RC706.

In: the machine. Out: diagnostics about unreachable states, final states with outgoing transitions,
and duplicate transitions.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def check_machine_rules(
    machine: StateMachine, report: Report, guessed: Sequence[Transition] = ()
) -> None:
    """Check the rules of a machine; `guessed` transitions count for reachability."""
    reached = _Reachability(machine, guessed).states
    _check_reachable(machine.states, reached, report)
    _check_final_states(machine, report)
    _check_duplicates(machine, report)


class _Reachability:
    """Computes the names of the states that can become active (`states`)."""

    def __init__(self, machine: StateMachine, guessed: Sequence[Transition]) -> None:
        self.states: set[str] = set()
        self._known = {state.name: state for state in machine.all_states()}
        self._around = {
            inner.name: outer for outer in self._known.values() for inner in outer.substates
        }
        self._ways: dict[str, list[Transition]] = {}
        for transition in (*machine.transitions, *guessed):
            self._ways.setdefault(transition.source, []).append(transition)
        self._todo: list[str] = []
        self._enter_all(machine.states, machine.start, parallel=False)
        while self._todo:
            self._follow(self._known[self._todo.pop()])

    def _enter_all(
        self, states: tuple[State, ...], start: tuple[str, ...], *, parallel: bool
    ) -> None:
        """Enter the start states, or all states if parallel or if there is no start state."""
        named = [state for state in start if state in self._known]
        for name in [state.name for state in states] if parallel or not named else named:
            self._enter(name)

    def _enter(self, name: str) -> None:
        state = self._known[name]
        if name not in self.states:
            self.states.add(name)
            self._todo.append(name)
            if state.history:
                self._enter_all((), state.start, parallel=False)
            else:
                self._enter_all(state.substates, state.start, parallel=state.parallel)
        outer = self._around.get(name)
        while outer is not None and outer.name not in self.states:
            self.states.add(outer.name)
            self._todo.append(outer.name)
            if outer.parallel:
                self._enter_all(outer.substates, (), parallel=True)
            outer = self._around.get(outer.name)

    def _follow(self, state: State) -> None:
        for transition in self._ways.get(state.name, ()):
            for target in transition.targets:
                if target in self._known:
                    self._enter(target)


def _check_reachable(states: tuple[State, ...], reached: set[str], report: Report) -> None:
    for state in states:
        if state.name in reached:
            _check_reachable(state.substates, reached, report)
        else:
            what = "the history" if state.history else "the state"
            called = (
                "" if "#" in state.name else f" `{state.name}`"
            )  # generated: the element has no id
            message = (
                f"unreachable: no transition leads to {what if called else 'this state'}{called}"
            )
            report.add(codes.UNREACHABLE_STATE, state.span, message)


def _check_final_states(machine: StateMachine, report: Report) -> None:
    ways: dict[str, Transition] = {}
    for transition in machine.transitions:
        ways.setdefault(transition.source, transition)
    for state in machine.all_states():
        if state.final and state.name in ways:
            report.add(
                codes.FINAL_STATE_LEFT,
                ways[state.name].span,
                f"`{state.name}` is an end state and cannot have outgoing transitions",
                notes=[Note(state.span, "declared as end state here")],
                help="make it an ordinary state instead",
            )


def _check_duplicates(machine: StateMachine, report: Report) -> None:
    first: dict[tuple[str, str, float | None, str], Transition] = {}
    for transition in machine.transitions:
        earlier = first.setdefault(
            (transition.source, transition.event, transition.after_s, transition.cond), transition
        )
        if earlier is not transition:
            report.add(
                codes.DUPLICATE_TRANSITION,
                transition.span,
                f"`{transition.source}` already has a transition {_cause(transition)}",
                notes=[Note(earlier.span, "first written here")],
            )


def _cause(transition: Transition) -> str:
    if transition.event:
        return f"on `{transition.event}`"
    return "without an event" if transition.after_s is None else f"after {transition.after_s:g} s"
