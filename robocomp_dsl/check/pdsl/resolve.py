"""Resolves and checks the parameters of a PDSL file.

In: the tree. Out: a `ParameterSet` with every parameter of a known type, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.causes import report_causes
from robocomp_dsl.check.codes import parameters as codes
from robocomp_dsl.check.doc_comments import documentation_of, plain
from robocomp_dsl.check.literals import TypeMismatch, as_float, as_int, join_names
from robocomp_dsl.check.names.duplicates import unique_by_name
from robocomp_dsl.check.pdsl.defaults import resolve_default
from robocomp_dsl.check.pdsl.rules import check_length, check_parameter
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.model.parameter import PATH, Kind, Parameter, ParameterSet
from robocomp_dsl.syntax.ast import pdsl as ast
from robocomp_dsl.syntax.ast.base import Name, Number
from robocomp_dsl.syntax.parse import parse_pdsl

KINDS = {
    "string": Kind.STRING,
    PATH: Kind.STRING,
    "int": Kind.INT,
    "float": Kind.FLOAT,
    "bool": Kind.BOOL,
}
_FOREIGN = {
    "double": "float",
    "real": "float",
    "number": "float",
    "integer": "int",
    "long": "int",
    "boolean": "bool",
    "str": "string",
    "text": "string",
    "file": PATH,
}
_NUMBERS = (Kind.INT, Kind.FLOAT)


def resolve_pdsl(file: Parsed[ast.File], report: Report) -> ParameterSet | None:
    """The parameters of a file; None if it has no parameter block."""
    parameters = _resolve(file, report)
    report_causes(report, file, parse_pdsl, _resolve)
    return parameters


def _resolve(file: Parsed[ast.File], report: Report) -> ParameterSet | None:
    tree = file.tree.parameters
    if tree is None:
        return None
    members = _members(tree.members, report)
    return ParameterSet(tree.name.text, file.source.path, tree.name.span, members, plain(tree.doc))


def _members(trees: Sequence[ast.Member], report: Report) -> tuple[Parameter, ...]:
    parameters = []
    for tree in unique_by_name(trees, "parameter", report):
        parameter = (
            _group(tree, report) if isinstance(tree, ast.Group) else _parameter(tree, report)
        )
        if parameter is not None:
            parameters.append(parameter)
    return tuple(parameters)


def _group(tree: ast.Group, report: Report) -> Parameter:
    low, high = _bounds(tree.count, Kind.INT, report)
    check_length(tree.count, low, high, "groups", report)
    return Parameter(
        tree.name.text,
        Kind.GROUP,
        tree.name.span,
        low=low,
        high=high,
        members=_members(tree.members, report),
        single=tree.count is None,
        doc=documentation_of(tree),
    )


def _parameter(tree: ast.Parameter, report: Report) -> Parameter | None:
    kind = _kind(tree.type, report)
    if kind is None:
        return None
    choices: tuple[str, ...] = ()
    if isinstance(tree.type, ast.Enumeration):
        named = [_Choice(choice) for choice in tree.type.choices]
        choices = tuple(choice.name.text for choice in unique_by_name(named, "choice", report))
    low, high = _bounds(tree.range, kind, report)
    shortest, longest = _length(tree.count, report)
    parameter = Parameter(
        tree.name.text,
        kind,
        tree.name.span,
        default=resolve_default(tree, kind, choices, shortest, report),
        low=low,
        high=high,
        unit=tree.unit.text if tree.unit else "",
        live=tree.live,
        choices=choices,
        doc=documentation_of(tree),
        is_path=isinstance(tree.type, Name) and tree.type.text.lower() == PATH,
        shortest=shortest,
        longest=longest,
    )
    check_parameter(tree, parameter, report)
    return parameter


class _Choice:
    """A choice of an enumeration as a named node."""

    def __init__(self, name: Name) -> None:
        self.name = name


def _kind(written: Name | ast.Enumeration, report: Report) -> Kind | None:
    if isinstance(written, ast.Enumeration):
        return Kind.CHOICE
    word = written.text.lower()
    if word not in KINDS:
        guess = _FOREIGN.get(word) or nearest(word, KINDS)
        report.add(
            codes.UNKNOWN_PARAMETER_TYPE,
            written.span,
            f"unknown parameter type `{written.text}`",
            label=f"did you mean `{guess}`?" if guess else "",
            help=f"it is {join_names(list(KINDS))}, or the choices in braces: `{{a, b}}`",
            fix=replace_fix(written.span, guess) if guess else None,
        )
    return KINDS.get(word)


def _length(written: ast.Range | None, report: Report) -> tuple[int | None, int | None]:
    """The smallest and the largest number of elements of a list; of a single value None."""
    if written is None:
        return None, None
    low, high = _bounds(written, Kind.INT, report)
    if not check_length(written, low, high, "values", report):
        return 1, None
    return int(low or 0), None if high is None else int(high)


def _bounds(
    written: ast.Range | None, kind: Kind, report: Report
) -> tuple[float | None, float | None]:
    if written is None or kind not in _NUMBERS:
        return None, None
    return _bound(written.low, kind, report), _bound(written.high, kind, report)


def _bound(written: Number | None, kind: Kind, report: Report) -> float | None:
    if written is None:
        return None
    try:
        return as_int(written) if kind is Kind.INT else as_float(written)
    except TypeMismatch as wrong:
        report.add(codes.RANGE_BOUND, written.span, f"invalid bound: {wrong}")
        return None
