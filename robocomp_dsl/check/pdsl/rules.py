"""The rules for a resolved parameter.

In: a parameter and its tree. Out: diagnostics.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import parameters as codes
from robocomp_dsl.check.idsl.units import check_unit
from robocomp_dsl.check.literals import OutOfRange
from robocomp_dsl.check.pdsl.values import check_range, format_number
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.syntax.ast import pdsl as ast

_NUMBERS = (Kind.INT, Kind.FLOAT)
MAX_GROUPS = 100_000


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
    if tree.range and _is_empty_range(tree.range, parameter, report):
        return
    if tree.default and parameter.default is not None:
        try:
            check_range(parameter.default, parameter)
        except OutOfRange as wrong:
            message = f"the default of `{parameter.name}` is out of range: {wrong}"
            report.add(codes.DEFAULT_OUT_OF_RANGE, tree.default.span, message)


def check_group(tree: ast.Group, parameter: Parameter, report: Report) -> None:
    """Check the length of a group list."""
    if tree.count is None or _is_empty_range(tree.count, parameter, report):
        return
    for bound in (parameter.low, parameter.high):
        if bound is not None and not 0 <= bound <= MAX_GROUPS:
            report.add(
                codes.GROUP_LENGTH,
                tree.count.span,
                f"a list of groups has 0 to {MAX_GROUPS} elements, not {format_number(bound)}",
            )


def _is_empty_range(tree: ast.Range, parameter: Parameter, report: Report) -> bool:
    if parameter.low is None or parameter.high is None or parameter.low <= parameter.high:
        return False
    report.add(
        codes.EMPTY_RANGE,
        tree.span,
        f"the range {format_number(parameter.low)} to {format_number(parameter.high)} is empty",
        help="write the smaller bound first",
        fix=_swap(tree),
    )
    return True


def _swap(tree: ast.Range) -> Fix | None:
    if tree.low is None or tree.high is None:
        return None
    edits = Edit(tree.low.span, tree.high.span.text), Edit(tree.high.span, tree.low.span.text)
    return Fix("swap the bounds", edits)
