"""Loads the components that a deployment imports.

In: its import statements. Out: components by name, and diagnostics.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.referenced_files import errors_of, find_referenced_file
from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.syntax.ast.base import Import

SUFFIXES = (".cdsl", ".ddsl")
CheckComponent = Callable[[Path, Workspace, Report], Component | None]
"""All passes of a CDSL file."""


@dataclass(slots=True)
class ImportedComponents:
    """Components by name. `broken`: a component has errors, so some may be missing."""

    components: dict[str, Component] = field(default_factory=dict)
    broken: bool = False


def imported_components(
    imports: Sequence[Import],
    beside: Path,
    workspace: Workspace,
    check: CheckComponent,
    report: Report,
) -> ImportedComponents:
    """The components of all imports; the errors of their files are added to the report."""
    imported = ImportedComponents()
    statements: dict[str, Import] = {}
    files: dict[str, Import] = {}
    for statement in imports:
        path = find_referenced_file(statement.path, SUFFIXES, beside, workspace, report)
        if path is None:
            imported.broken = True
            continue
        earlier = files.setdefault(canonical_path(path), statement)
        if earlier is not statement:
            _report_repeated(statement, earlier, report)
            continue
        if path.suffix.lower() == ".ddsl":
            continue  # definitions of groups, see `definitions`
        component = _checked(path, workspace, check, imported, report)
        if component is not None:
            first = statements.setdefault(component.name, statement)
            if first is not statement:
                _report_same_name(component, imported.components[component.name], statement, report)
            else:
                imported.components[component.name] = component
    return imported


def _checked(
    path: Path,
    workspace: Workspace,
    check: CheckComponent,
    imported: ImportedComponents,
    report: Report,
) -> Component | None:
    component_report = Report()
    component = check(path, workspace, component_report)
    imported.broken |= component_report.has_errors
    report.extend(errors_of(component_report))
    return component


def _report_repeated(second: Import, first: Import, report: Report) -> None:
    report.add(
        codes.DUPLICATE_IMPORT,
        second.path.span,
        f"`{Path(second.path.value).name}` is imported twice",
        notes=[Note(first.path.span, "first imported here")],
    )


def _report_same_name(
    second: Component, first: Component, statement: Import, report: Report
) -> None:
    report.add(
        codes.DUPLICATE_NAME,
        statement.path.span,
        f"there are two components called `{second.name}`",
        notes=[
            Note(first.span, "first declared here"),
            Note(second.span, "also declared here"),
        ],
        help="give one of them another name, or remove it",
    )
