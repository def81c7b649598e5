"""The rules for a resolved SMDSL machine.

In: the machine and its blocks. Out: diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.check.states.resolve_smdsl import Blocks
from robocomp_dsl.check.states.rules import check_machine_rules
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.syntax.ast import smdsl as ast


def check_smdsl_rules(machine: StateMachine, blocks: Blocks, report: Report) -> None:
    """Check initial and end states, and the rules of all state machines."""
    for block in blocks.by_parent.values():
        _check_initial_and_final(block, report)
    check_machine_rules(machine, report, blocks.guessed)


def _check_initial_and_final(block: ast.Block, report: Report) -> None:
    parallel = isinstance(block, ast.Substates) and block.parallel
    if parallel:
        for name in (block.initial, block.end):
            if name is not None:
                report.add(
                    codes.PARALLEL_INITIAL_OR_FINAL,
                    name.span,
                    f"`{name.text}` cannot be initial or end state: its block is parallel",
                    help="list it under `states`",
                )
    elif block.initial is None:
        report.add(
            codes.NO_INITIAL_STATE,
            block.name.span,
            f"`{block.name.text}` has no initial state",
            help="write `initial_state NAME;`",
        )
