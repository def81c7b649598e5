"""From the tree of a PDSL file to its parameters, judged.

In: the tree. Out: a `ParameterSet` with every parameter whose kind is known, and findings.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import Misfit, OutOfRange, as_float, as_int, listing
from robocomp_dsl.check.names import without_repeats
from robocomp_dsl.check.parameter_values import as_kind
from robocomp_dsl.check.rules_pdsl import judge_group, judge_parameter
from robocomp_dsl.diagnostics import Report, nearest
from robocomp_dsl.model.parameter import Kind, Parameter, ParameterSet
from robocomp_dsl.model.types import Literal
from robocomp_dsl.syntax import ast_pdsl as ast
from robocomp_dsl.syntax.ast_base import Name, Number

KINDS = {"string": Kind.STRING, "int": Kind.INT, "float": Kind.FLOAT, "bool": Kind.BOOL}
_FOREIGN = {
    "double": "float",
    "real": "float",
    "number": "float",
    "integer": "int",
    "long": "int",
    "boolean": "bool",
    "str": "string",
    "text": "string",
    "path": "string",
}
_NUMBERS = (Kind.INT, Kind.FLOAT)


def resolve_pdsl(file: Parsed[ast.File], report: Report) -> ParameterSet | None:
    """The parameters that a file describes; None where none are to be seen."""
    tree = file.tree.parameters
    if tree is None:
        return None
    members = _members(tree.members, report)
    return ParameterSet(tree.name.text, file.source.path, tree.name.span, members, tree.doc)


def _members(trees: Sequence[ast.Member], report: Report) -> tuple[Parameter, ...]:
    made = []
    for tree in without_repeats(trees, "parameter", report):
        one = _group(tree, report) if isinstance(tree, ast.Group) else _parameter(tree, report)
        if one is not None:
            made.append(one)
    return tuple(made)


def _group(tree: ast.Group, report: Report) -> Parameter:
    low, high = _bounds(tree.count, Kind.INT, report)
    made = Parameter(
        tree.name.text,
        Kind.GROUP,
        tree.name.span,
        low=low,
        high=high,
        members=_members(tree.members, report),
        single=tree.count is None,
        doc=tree.doc,
    )
    judge_group(tree, made, report)
    return made


def _parameter(tree: ast.Parameter, report: Report) -> Parameter | None:
    kind = _kind(tree.type, report)
    if kind is None:
        return None
    choices: tuple[str, ...] = ()
    if isinstance(tree.type, ast.Enumeration):
        named = [_Choice(one) for one in tree.type.choices]
        choices = tuple(one.name.text for one in without_repeats(named, "choice", report))
    low, high = _bounds(tree.range, kind, report)
    made = Parameter(
        tree.name.text,
        kind,
        tree.name.span,
        default=_default(tree, kind, choices, report),
        low=low,
        high=high,
        unit=tree.unit.text if tree.unit else "",
        live=tree.live,
        choices=choices,
        doc=tree.doc,
    )
    judge_parameter(tree, made, report)
    return made


class _Choice:
    """A choice as a thing that has a name."""

    def __init__(self, name: Name) -> None:
        self.name = name


def _kind(written: Name | ast.Enumeration, report: Report) -> Kind | None:
    if isinstance(written, ast.Enumeration):
        return Kind.CHOICE
    word = written.text.lower()
    if word not in KINDS:
        guess = _FOREIGN.get(word) or nearest(word, KINDS)
        report.add(
            codes.UNKNOWN_KIND,
            written.span,
            f"there is no kind of parameter `{written.text}`",
            label=f"did you mean `{guess}`?" if guess else "",
            help=f"it is {listing(list(KINDS))}, or the choices in braces: `{{a, b}}`",
            fix=replace(written.span, guess) if guess else None,
        )
    return KINDS.get(word)


def _default(
    tree: ast.Parameter, kind: Kind, choices: Sequence[str], report: Report
) -> Literal | None:
    if tree.default is None:
        return None
    try:
        return as_kind(tree.default, kind, choices)
    except Misfit as wrong:
        code = codes.PARAMETER_CHOICE if isinstance(wrong, OutOfRange) else codes.PARAMETER_DEFAULT
        fix = replace(tree.default.span, wrong.replacement) if wrong.replacement else None
        what = f"the default of `{tree.name.text}` does not fit: {wrong}"
        report.add(code, tree.default.span, what, label=wrong.label, fix=fix)
        return None


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
    except Misfit as wrong:
        report.add(codes.RANGE_BOUND, written.span, f"this bound does not fit: {wrong}")
        return None
