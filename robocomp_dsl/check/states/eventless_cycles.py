"""The rule for cycles of transitions without events: RC711.

In: an SCXML machine. Out: a diagnostic for each transition that starts an endless loop. SCXML takes
transitions without an event until none is enabled (section 3.13), so a cycle of them without
conditions never ends.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.statemachine import State, StateMachine, Transition


def check_eventless_cycles(machine: StateMachine, report: Report) -> None:
    """Report each cycle once, at its first transition."""
    chart = _Chart(machine)
    reported: set[int] = set()
    for transition in chart.eventless:
        cycle = chart.cycle_from(transition)
        if cycle and id(transition) not in reported:
            reported |= {id(member) for member in cycle}
            names = " → ".join(f"`{member.source}`" for member in (*cycle, cycle[0]))
            report.add(
                codes.EVENTLESS_CYCLE,
                transition.span,
                f"endless loop of transitions without event and condition: {names}",
                notes=[Note(member.span, "continues here") for member in cycle[1:]],
                help="give one of the transitions an event or a condition",
            )


class _Chart:
    """Which transition without event follows another one."""

    def __init__(self, machine: StateMachine) -> None:
        self._states = {state.name: state for state in machine.all_states()}
        self._outer = {
            inner.name: outer for outer in self._states.values() for inner in outer.substates
        }
        self.eventless: list[Transition] = []
        self._first: dict[str, Transition] = {}
        for transition in machine.transitions:
            if not transition.event and transition.after_s is None:
                self.eventless.append(transition)
                self._first.setdefault(transition.source, transition)

    def cycle_from(self, start: Transition) -> list[Transition]:
        """The transitions that are taken after `start`, if they lead to it again; else empty."""
        taken = [start]
        transition: Transition | None = start
        while transition is not None and not transition.cond:
            transition = self._next(transition)
            if transition is start:
                return taken
            if transition in taken:
                return []
            if transition is not None:
                taken.append(transition)
        return []

    def _next(self, transition: Transition) -> Transition | None:
        """The transition that is enabled after this one: inner states come first."""
        targets = [self._states[name] for name in transition.targets if name in self._states]
        if len(targets) != 1:
            return None  # of several regions, one may end the loop of another; none: RC707
        for state in self._entered(targets[0]):
            if state.parallel or state.history:
                return None
            if state.name in self._first:
                return self._first[state.name]
        return None

    def _entered(self, target: State) -> list[State]:
        """The active states after entering `target`, innermost first."""
        chain = [target]
        while (outer := self._outer.get(chain[0].name)) is not None:
            chain.insert(0, outer)
        state = target
        while state.substates and not state.parallel:
            named = state.start or tuple(inner.name for inner in state.substates if inner.initial)
            name = named[0] if named else state.substates[0].name
            if name not in self._states or self._states[name] in chain:
                break
            state = self._states[name]
            chain.append(state)
        return chain[::-1]
