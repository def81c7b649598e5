"""Checks definitions of groups, each by itself, and locates what only its instances show.

In: definitions. Out: diagnostics about a definition, once; and those about an instance, located at
the instance with a note at the definition.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from collections.abc import Set as AbstractSet
from typing import TypeAlias

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.codes import placement as placement_codes
from robocomp_dsl.check.ddsl.definitions import DefinitionFile, DefinitionFiles
from robocomp_dsl.check.ddsl.scopes import NAME_SEPARATOR, DeploymentScope
from robocomp_dsl.check.workspace.referenced_files import errors_of
from robocomp_dsl.diagnostics import Diagnostic, Note, Report
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast

Known: TypeAlias = AbstractSet[tuple[str, Span]]
"""Codes and places that were reported for a definition itself."""
CheckDeployment: TypeAlias = Callable[[DefinitionFile, ast.Deployment, Report], None]
_OF_INSTANCES = {
    codes.UNKNOWN_HOST.id,
    placement_codes.UNKNOWN_LABEL.id,
    placement_codes.NO_CANDIDATE.id,
}
"""What only an instance decides: the hosts are those of its deployment."""


def check_definitions(
    definitions: DefinitionFiles, own: DefinitionFile, check: CheckDeployment, report: Report
) -> Known:
    """Report what is wrong in each definition; of imported files the errors only."""
    known: set[tuple[str, Span]] = set()
    for file in definitions.files.values():
        for group in file.groups.values():
            found = Report()
            instance = ast.Group(group.span, group.name, definition=group.name)
            check(file, ast.Deployment(group.span, group.name, groups=(instance,)), found)
            _check_after(group, found)
            inner = Report()
            for diagnostic in found:
                key = (diagnostic.code.id, diagnostic.span)
                is_inside = any(_contains(each, diagnostic.span) for each in file.groups.values())
                if is_inside and key not in known and diagnostic.code.id not in _OF_INSTANCES:
                    known.add(key)
                    inner.extend([diagnostic])
            report.extend(inner if file is own else errors_of(inner))
    return known


def _check_after(group: ast.Group, report: Report) -> None:
    for name in group.after:
        report.add(
            codes.UNKNOWN_INSTANCE,
            name.span,
            f"the definition `{group.name.text}` cannot wait for `{name.text}`: nothing outside is"
            " known in it",
            help=f"write it in an instance: `group {group.name.text}1 : {group.name.text}"
            f" {{ after {name.text}; }};`",
        )


def located_at_instances(
    found: Report, known: Known, scope: DeploymentScope
) -> Iterator[Diagnostic]:
    """What was found in a deployment, without what was reported for definitions."""
    instances = [nested for nested in scope.descendants if nested.definitions]
    for diagnostic in found:
        if (diagnostic.code.id, diagnostic.span) in known:
            continue
        around = [
            nested
            for nested in instances
            if any(_contains(definition, diagnostic.span) for definition in nested.definitions)
        ]
        if not around:
            yield diagnostic
            continue
        named = (n for n in around if f"`{n.path}{NAME_SEPARATOR}" in diagnostic.message)
        yield _at_instance(diagnostic, next(named, around[0]))


def _at_instance(diagnostic: Diagnostic, scope: DeploymentScope) -> Diagnostic:
    """The diagnostic at the outermost instance, which is in the deployment itself."""
    outermost = [nested for nested in scope.ancestors if nested.definitions][-1]
    return diagnostic.replace(
        span=outermost.tree.name.span,
        label="",
        notes=(Note(diagnostic.span, "this part of its definition"), *diagnostic.notes),
        fix=None,
        unknown=None,
    )


def _contains(group: ast.Group, span: Span) -> bool:
    outer = group.span
    same = outer.source.path == span.source.path
    return same and outer.start <= span.start and span.end <= outer.end
