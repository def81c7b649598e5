"""The default of a parameter: one value, or the values of a list.

In: the tree of a parameter. Out: the default, and diagnostics. One value as the default of a list
is that of each element that the list has at least.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.codes import parameters as codes
from robocomp_dsl.check.literals import OutOfRange, TypeMismatch
from robocomp_dsl.check.pdsl.values import as_kind, check_range
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.model.parameter import Default, Kind, Parameter
from robocomp_dsl.model.types import Literal
from robocomp_dsl.syntax.ast import base
from robocomp_dsl.syntax.ast import pdsl as ast
from robocomp_dsl.syntax.ast.base import LiteralList


def resolve_default(
    tree: ast.Parameter, kind: Kind, choices: Sequence[str], shortest: int | None, report: Report
) -> Default | None:
    """The default of `tree`; None: a value is required. `shortest` is None for a single value."""
    written, name = tree.default, tree.name.text
    if isinstance(written, LiteralList):
        if shortest is None:
            _report_list(tree, written, report)
            return None
        elements = [
            _value(f"{name}[{index}]", item, kind, choices, report)
            for index, item in enumerate(written.items)
        ]
        return None if None in elements else tuple(e for e in elements if e is not None)
    if written is None:
        return None if shortest is None or shortest else ()
    value = _value(name, written, kind, choices, report)
    if value is None or shortest is None:
        return value
    if not shortest:
        report.add(
            codes.UNUSED_DEFAULT,
            written.span,
            f"`{name}` may be empty, and starts empty: this default is not used",
            fix=replace_fix(written.span, f"{{{written.span.text}}}"),
        )
    return (value,) * shortest


def _report_list(tree: ast.Parameter, written: LiteralList, report: Report) -> None:
    name, size = tree.name, len(written.items)
    behind = name.span.subspan(name.span.end, name.span.end)
    length = f"[{size}]" if size else "[]"
    report.add(
        codes.DEFAULT_IS_LIST,
        written.span,
        f"the default of `{name.text}` is a list, but `{name.text}` is one value",
        help="the length after the name declares a list",
        fix=Fix(f"write `{name.text}{length}`", (Edit(behind, length),)),
    )


def _value(
    name: str, written: base.Literal, kind: Kind, choices: Sequence[str], report: Report
) -> Literal | None:
    try:
        return as_kind(written, kind, choices)
    except TypeMismatch as wrong:
        code = (
            codes.PARAMETER_DEFAULT_VALUE
            if isinstance(wrong, OutOfRange)
            else codes.PARAMETER_DEFAULT_TYPE
        )
        fix = replace_fix(written.span, wrong.replacement) if wrong.replacement else None
        message = f"the default of `{name}` is invalid: {wrong}"
        report.add(code, written.span, message, label=wrong.label, fix=fix)
        return None


def check_default(tree: ast.Parameter, parameter: Parameter, report: Report) -> None:
    """Check the values of a default against the range, and the number of them."""
    written, default = tree.default, parameter.default
    if isinstance(written, LiteralList) and isinstance(default, tuple):
        for index, (item, value) in enumerate(zip(written.items, default, strict=True)):
            name = f"{parameter.name}[{index}]"
            _check_range(name, item, value, parameter, report)
        _check_number(tree, written, parameter, report)
    elif written is not None and default is not None:
        values = default if isinstance(default, tuple) else (default,)
        for value in values[:1]:
            _check_range(parameter.name, written, value, parameter, report)


def _check_range(
    name: str,
    written: base.Literal | LiteralList,
    value: Literal,
    parameter: Parameter,
    report: Report,
) -> None:
    try:
        check_range(value, parameter)
    except OutOfRange as wrong:
        message = f"the default of `{name}` is out of range: {wrong}"
        report.add(codes.DEFAULT_OUT_OF_RANGE, written.span, message)


def _check_number(
    tree: ast.Parameter, written: LiteralList, parameter: Parameter, report: Report
) -> None:
    """Check the number of values in braces; the fix changes the length of the list."""
    size = len(written.items)
    shortest, longest = parameter.shortest or 0, parameter.longest
    if tree.count is None or (size >= shortest and (longest is None or size <= longest)):
        return
    low = min(size, shortest)
    high = "" if longest is None else max(size, longest)
    length = f"[{low}:{high}]"
    report.add(
        codes.LIST_DEFAULT_LENGTH,
        written.span,
        f"the default of `{parameter.name}` has {size} value{'' if size == 1 else 's'}, "
        f"the list has {parameter.describe_length()}",
        help="one value without braces is the default of each element",
        fix=Fix(f"write `{parameter.name}{length}`", (Edit(tree.count.span, length),)),
    )
