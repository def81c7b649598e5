"""What a state machine may not say although its names are known.

In: the machine and its blocks. Out: findings.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.resolve_smdsl import Blocks
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.syntax import ast_smdsl as ast


def judge_smdsl(machine: StateMachine, blocks: Blocks, report: Report) -> None:
    """Report what is wrong with beginnings, ends and ways."""
    for block in blocks.inside.values():
        _judge_ends(block, report)
    _judge_level(machine.states, machine.transitions, report, parallel=False)
    _judge_repeats(machine, report)


def _judge_ends(block: ast.Block, report: Report) -> None:
    parallel = isinstance(block, ast.Substates) and block.parallel
    if parallel:
        for name in (block.initial, block.end):
            if name is not None:
                report.add(
                    codes.PARALLEL_ENDS,
                    name.span,
                    f"`{name.text}` is neither first nor last: parallel states are active together",
                    help="list it under `states`",
                )
    elif block.initial is None:
        report.add(
            codes.NO_INITIAL_STATE,
            block.name.span,
            f"`{block.name.text}` has no initial state",
            help="write `initial_state NAME;`",
        )


def _judge_level(
    states: tuple[State, ...],
    transitions: tuple[Transition, ...],
    report: Report,
    *,
    parallel: bool,
) -> None:
    """States that are never entered, and ends that are left, on this level and inside."""
    ways: dict[str, set[str]] = {}
    for one in transitions:
        ways.setdefault(one.source, set()).add(one.target)
    leaving = _leaving(states, ways)
    reached = {s.name for s in states if s.initial or parallel}
    todo = list(reached)
    while todo:
        for target in leaving.get(todo.pop(), set()) - reached:
            reached.add(target)
            todo.append(target)
    for state in states:
        if reached and state.name not in reached:
            report.add(
                codes.UNREACHABLE_STATE, state.span, f"no way leads to the state `{state.name}`"
            )
        if state.final and ways.get(state.name):
            out = next(t for t in transitions if t.source == state.name)
            report.add(
                codes.END_WITH_WAY_OUT,
                out.span,
                f"`{state.name}` is an end state and cannot be left",
                notes=[Note(state.span, "it is declared as the end here")],
                help="list it under `states` instead",
            )
        _judge_level(state.inside, transitions, report, parallel=state.parallel)


def _leaving(states: tuple[State, ...], ways: dict[str, set[str]]) -> dict[str, set[str]]:
    """Where the states lead, the ways out of what is inside them included."""
    made = {}
    for state in states:
        inner = _leaving(state.inside, ways)
        made[state.name] = ways.get(state.name, set()).union(*inner.values())
    return made


def _judge_repeats(machine: StateMachine, report: Report) -> None:
    first: dict[tuple[str, str, float | None], Transition] = {}
    for one in machine.transitions:
        earlier = first.setdefault((one.source, one.event, one.after_s), one)
        if earlier is not one:
            by = f"by `{one.event}`" if one.event else f"after {one.after_s:g} s"
            report.add(
                codes.REPEATED_TRANSITION,
                one.span,
                f"`{one.source}` is left {by} already",
                notes=[Note(earlier.span, "it is first written here")],
            )
