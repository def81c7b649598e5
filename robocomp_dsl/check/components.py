"""The components that a deployment imports.

In: its import statements. Out: components by name, and findings.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import identity
from robocomp_dsl.check.named_files import errors_of, find_beside
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.syntax.ast_base import Import

CheckComponent = Callable[[Path, Workspace, Report], Component | None]
"""All passes of a CDSL file."""


@dataclass(slots=True)
class Imported:
    """Components by name. `broken`: one has errors, so that something may be missing here."""

    components: dict[str, Component] = field(default_factory=dict)
    broken: bool = False


def imported_components(
    imports: Sequence[Import],
    beside: Path,
    workspace: Workspace,
    check: CheckComponent,
    report: Report,
) -> Imported:
    """The components of all imports; the errors of their files are added to the report."""
    made = Imported()
    statements: dict[str, Import] = {}
    files: dict[str, Import] = {}
    for one in imports:
        path = find_beside(one.path, (".cdsl",), beside, workspace, report)
        if path is None:
            made.broken = True
            continue
        earlier = files.setdefault(identity(path), one)
        if earlier is not one:
            _report_repeated(one, earlier, report)
            continue
        component = _checked(path, workspace, check, made, report)
        if component is not None:
            first = statements.setdefault(component.name, one)
            if first is not one:
                _report_same_name(component, made.components[component.name], one, report)
            else:
                made.components[component.name] = component
    return made


def _checked(
    path: Path, workspace: Workspace, check: CheckComponent, made: Imported, report: Report
) -> Component | None:
    found = Report()
    component = check(path, workspace, found)
    made.broken |= found.failed
    report.extend(errors_of(found))
    return component


def _report_repeated(second: Import, first: Import, report: Report) -> None:
    report.add(
        codes.REPEATED_IMPORT,
        second.path.span,
        f"`{Path(second.path.value).name}` is imported twice",
        notes=[Note(first.path.span, "first imported here")],
    )


def _report_same_name(
    second: Component, first: Component, statement: Import, report: Report
) -> None:
    report.add(
        codes.REPEATED_NAME,
        statement.path.span,
        f"there are two components called `{second.name}`",
        notes=[
            Note(first.span, "one is declared here"),
            Note(second.span, "the other one is declared here"),
        ],
        help="give one of them another name, or remove it",
    )
