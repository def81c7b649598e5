"""Assignments to fields and parameters: each path once, each value of the right type.

In: assignments of an output, service or call, and the parameters that they build. Out: one
`BuiltValue` for each parameter, and findings.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.bdsl.expressions import value_for
from robocomp_dsl.check.bdsl.paths import ResolvedPath, field_path
from robocomp_dsl.check.bdsl.scopes import Scope
from robocomp_dsl.check.codes import bridge_values as codes
from robocomp_dsl.diagnostics import Edit, Fix, Note, Report
from robocomp_dsl.model.bridge_values import BuiltValue, Expression, FieldAssignment
from robocomp_dsl.model.interface import Param
from robocomp_dsl.syntax.ast import bdsl as ast


def build_values(
    params: tuple[Param, ...],
    trees: Iterable[ast.Assignment],
    scope: Scope,
    whole: Expression | None = None,
) -> tuple[BuiltValue, ...] | None:
    """The values of `params`; None if an assignment is faulty.

    `whole` is the value of the only parameter, which the assignments override.
    """
    values: dict[str, Expression] = {}
    fields: dict[str, list[FieldAssignment]] = {param.name: [] for param in params}
    resolved: list[tuple[ast.Assignment, ResolvedPath]] = []
    is_valid = True
    for tree in trees:
        path = field_path(tree.path, params, scope.context)
        if path is None:
            is_valid = False
            continue
        is_valid &= _is_first(tree, path, resolved, scope.context.report)
        resolved.append((tree, path))
        value = value_for(tree.value, path.target, scope)
        if value is None:
            is_valid = False
        elif path.parts:
            fields[path.param.name].append(FieldAssignment(path.parts, value))
        else:
            values[path.param.name] = value
    if not is_valid:
        return None
    return tuple(
        BuiltValue(param, values.get(param.name, whole), tuple(fields[param.name]))
        for param in params
    )


def _is_first(
    tree: ast.Assignment,
    path: ResolvedPath,
    earlier: list[tuple[ast.Assignment, ResolvedPath]],
    report: Report,
) -> bool:
    """Whether no assignment before has this field, a part of it, or what it is a part of."""
    for other_tree, other in earlier:
        count = min(len(path.parts), len(other.parts))
        if path.param is not other.param or path.parts[:count] != other.parts[:count]:
            continue
        same = len(path.parts) == len(other.parts)
        text, first = tree.path.text, other_tree.path.text
        report.add(
            codes.ASSIGNED_TWICE,
            tree.path.span,
            f"`{text}` is assigned twice" if same else f"`{text}` and `{first}` overlap",
            notes=[Note(other_tree.path.span, "first assigned here")],
            help="" if same else "assign either the whole or its parts",
            fix=Fix("remove the second assignment", (Edit(tree.span, ""),)) if same else None,
        )
        return False
    return True


def check_missing(
    params: Iterable[Param], values: Iterable[BuiltValue], tree: ast.Call, report: Report
) -> bool:
    """Whether a call has a value for each parameter; reports those without."""
    assigned = {value.param.name for value in values if value.value or value.assignments}
    missing = [param for param in params if param.name not in assigned]
    for param in missing:
        report.add(
            codes.FUNCTION_ARGUMENTS,
            tree.name.span,
            f"the call `{tree.name.text}` lacks the parameter `{param.name}`",
            notes=[Note(param.span, "it is declared here")],
            help=f"write `{param.name} = …;` in its braces",
        )
    return not missing
