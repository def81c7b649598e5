"""What an SMDSL file may not say although its names are known.

In: the machine and its blocks. Out: findings.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.resolve_smdsl import Blocks
from robocomp_dsl.check.rules_states import judge_machine
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.syntax import ast_smdsl as ast


def judge_smdsl(machine: StateMachine, blocks: Blocks, report: Report) -> None:
    """Report what is wrong with beginnings and ends, and what `rules_states` says."""
    for block in blocks.inside.values():
        _judge_ends(block, report)
    judge_machine(machine, report, blocks.guessed)


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
