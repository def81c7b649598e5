"""What no state machine may say, in whatever language it is written: RC704, RC705, RC706.

In: the machine. Out: findings about states that are never entered, ends that are left, and
transitions that are never taken.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def judge_machine(
    machine: StateMachine, report: Report, guessed: Sequence[Transition] = ()
) -> None:
    """Report what is wrong with ways and ends; what is `guessed` leads somewhere as well."""
    reached = _Reached(machine, guessed).states
    _judge_level(machine.states, reached, report)
    _judge_ends(machine, report)
    _judge_repeats(machine, report)


class _Reached:
    """`states` are the names of those that can become active."""

    def __init__(self, machine: StateMachine, guessed: Sequence[Transition]) -> None:
        self.states: set[str] = set()
        self._known = {one.name: one for one in machine.every_state()}
        self._around = {
            inner.name: outer for outer in self._known.values() for inner in outer.inside
        }
        self._ways: dict[str, list[Transition]] = {}
        for way in (*machine.transitions, *guessed):
            self._ways.setdefault(way.source, []).append(way)
        self._todo: list[str] = []
        self._enter_all(machine.states, machine.start, parallel=False)
        while self._todo:
            self._follow(self._known[self._todo.pop()])

    def _enter_all(
        self, states: tuple[State, ...], start: tuple[str, ...], *, parallel: bool
    ) -> None:
        """What is active when states are entered as a whole; without a start it may be any."""
        named = [one for one in start if one in self._known]
        for name in [one.name for one in states] if parallel or not named else named:
            self._enter(name)

    def _enter(self, name: str) -> None:
        state = self._known[name]
        if name not in self.states:
            self.states.add(name)
            self._todo.append(name)
            if state.history:
                self._enter_all((), state.start, parallel=False)
            else:
                self._enter_all(state.inside, state.start, parallel=state.parallel)
        outer = self._around.get(name)
        while outer is not None and outer.name not in self.states:
            self.states.add(outer.name)
            self._todo.append(outer.name)
            if outer.parallel:
                self._enter_all(outer.inside, (), parallel=True)
            outer = self._around.get(outer.name)

    def _follow(self, state: State) -> None:
        for way in self._ways.get(state.name, ()):
            for target in way.targets:
                if target in self._known:
                    self._enter(target)


def _judge_level(states: tuple[State, ...], reached: set[str], report: Report) -> None:
    for state in states:
        if state.name in reached:
            _judge_level(state.inside, reached, report)
        else:
            what = "the history" if state.history else "the state"
            called = "" if "#" in state.name else f" `{state.name}`"  # made up: it has no id
            said = f"no way leads to {what if called else 'this state'}{called}"
            report.add(codes.UNREACHABLE_STATE, state.span, said)


def _judge_ends(machine: StateMachine, report: Report) -> None:
    ways: dict[str, Transition] = {}
    for way in machine.transitions:
        ways.setdefault(way.source, way)
    for state in machine.every_state():
        if state.final and state.name in ways:
            report.add(
                codes.END_WITH_WAY_OUT,
                ways[state.name].span,
                f"`{state.name}` is an end state and cannot be left",
                notes=[Note(state.span, "it is declared as the end here")],
                help="make it an ordinary state instead",
            )


def _judge_repeats(machine: StateMachine, report: Report) -> None:
    first: dict[tuple[str, str, float | None, str], Transition] = {}
    for one in machine.transitions:
        earlier = first.setdefault((one.source, one.event, one.after_s, one.cond), one)
        if earlier is not one:
            report.add(
                codes.REPEATED_TRANSITION,
                one.span,
                f"`{one.source}` is left {_cause(one)} already",
                notes=[Note(earlier.span, "it is first written here")],
            )


def _cause(one: Transition) -> str:
    if one.event:
        return f"by `{one.event}`"
    return "at once" if one.after_s is None else f"after {one.after_s:g} s"
