"""The rules for a resolved parameter.

In: a parameter and its tree. Out: diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import parameters as codes
from robocomp_dsl.check.idsl.units import check_unit
from robocomp_dsl.check.pdsl.defaults import check_default
from robocomp_dsl.check.pdsl.values import format_number
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.syntax.ast import pdsl as ast

_NUMBERS = (Kind.INT, Kind.FLOAT)
MAX_ELEMENTS = 100_000


def check_parameter(tree: ast.Parameter, parameter: Parameter, report: Report) -> None:
    """Check the range, the unit and the default of a parameter."""
    is_number = parameter.kind in _NUMBERS
    if tree.unit:
        check_unit(tree.unit, f"`{parameter.name}`", report, is_number=is_number)
    if tree.range and not is_number:
        report.add(
            codes.RANGE_WITHOUT_NUMBER,
            tree.range.span,
            f"`{parameter.name}` is not a number and cannot have a range",
            fix=Fix("remove the range", (Edit(tree.range.span, ""),)),
        )
    if not (tree.range and is_empty_range(tree.range, parameter.low, parameter.high, report)):
        check_default(tree, parameter, report)


def check_length(
    tree: ast.Range | None, low: float | None, high: float | None, noun: str, report: Report
) -> bool:
    """Whether a list of `noun` may have `low` to `high` elements; reports it otherwise."""
    if tree is None or is_empty_range(tree, low, high, report):
        return tree is None
    for bound in (low, high):
        if bound is not None and not 0 <= bound <= MAX_ELEMENTS:
            report.add(
                codes.LIST_LENGTH,
                tree.span,
                f"a list of {noun} has 0 to {MAX_ELEMENTS} elements, not {format_number(bound)}",
            )
            return False
    return True


def is_empty_range(tree: ast.Range, low: float | None, high: float | None, report: Report) -> bool:
    """Whether no number is between the bounds, which is reported."""
    if low is None or high is None or low <= high:
        return False
    report.add(
        codes.EMPTY_RANGE,
        tree.span,
        f"the range {format_number(low)} to {format_number(high)} is empty",
        help="write the smaller bound first",
        fix=_swap(tree),
    )
    return True


def _swap(tree: ast.Range) -> Fix | None:
    if tree.low is None or tree.high is None:
        return None
    edits = Edit(tree.low.span, tree.high.span.text), Edit(tree.high.span, tree.low.span.text)
    return Fix("swap the bounds", edits)
