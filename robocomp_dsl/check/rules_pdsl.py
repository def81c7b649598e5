"""What a parameter may not say although its kind is known.

In: a parameter and its tree. Out: findings.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.literals import OutOfRange
from robocomp_dsl.check.parameter_values import check_range, plain
from robocomp_dsl.check.units import judge_unit
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.syntax import ast_pdsl as ast

_NUMBERS = (Kind.INT, Kind.FLOAT)
MOST_GROUPS = 100_000


def judge_parameter(tree: ast.Parameter, made: Parameter, report: Report) -> None:
    """Report what is wrong with the range, the unit or the default of a parameter."""
    is_number = made.kind in _NUMBERS
    if tree.unit:
        judge_unit(tree.unit, f"`{made.name}`", report, is_number=is_number)
    if tree.range and not is_number:
        report.add(
            codes.RANGE_WITHOUT_NUMBER,
            tree.range.span,
            f"`{made.name}` is not a number and has no range",
            fix=Fix("remove the range", (Edit(tree.range.span, ""),)),
        )
    if tree.range and _is_upside_down(tree.range, made, report):
        return
    if tree.default and made.default is not None:
        try:
            check_range(made.default, made)
        except OutOfRange as wrong:
            what = f"the default of `{made.name}` is out of range: {wrong}"
            report.add(codes.DEFAULT_OUT_OF_RANGE, tree.default.span, what)


def judge_group(tree: ast.Group, made: Parameter, report: Report) -> None:
    """Report what is wrong with the length of a list of groups."""
    if tree.count is None or _is_upside_down(tree.count, made, report):
        return
    for bound in (made.low, made.high):
        if bound is not None and not 0 <= bound <= MOST_GROUPS:
            report.add(
                codes.GROUP_LENGTH,
                tree.count.span,
                f"a list of groups has 0 to {MOST_GROUPS} elements, not {plain(bound)}",
            )


def _is_upside_down(tree: ast.Range, made: Parameter, report: Report) -> bool:
    if made.low is None or made.high is None or made.low <= made.high:
        return False
    report.add(
        codes.EMPTY_RANGE,
        tree.span,
        f"no value is within {plain(made.low)} to {plain(made.high)}",
        help="write the smaller bound first",
        fix=_swap(tree),
    )
    return True


def _swap(tree: ast.Range) -> Fix | None:
    if tree.low is None or tree.high is None:
        return None
    edits = Edit(tree.low.span, tree.high.span.text), Edit(tree.high.span, tree.low.span.text)
    return Fix("swap the bounds", edits)
