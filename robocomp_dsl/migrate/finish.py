"""The last stages of a migration: generation, a final check, and the report.

In: the plan and its output folder. Out: more files, and findings.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check.passes import check_bdsl, check_cdsl, check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.plan import plan as files_of
from robocomp_dsl.generate.regeneration.update import update_user_files
from robocomp_dsl.migrate.ddsl import PEERS
from robocomp_dsl.migrate.migration import MigrationPlan
from robocomp_dsl.migrate.migration_report import FILE, ReportContent, report_text
from robocomp_dsl.migrate.review_ports import add_as_errors
from robocomp_dsl.migrate.worker_codes import MISSING_MODULE


def generate_components(
    plan: MigrationPlan, out: Path, folders: Sequence[Path], report: Report
) -> Iterator[tuple[str, list[OutputFile]]]:
    """For each component, its folder and the files that `rcgen component` generates there."""
    for place, moved in plan.components:
        path = out / place / moved.description
        component = check_cdsl(path, Workspace(folders), report)
        if moved.component is not None and component is not None:
            found = Report()
            files = update_user_files(path.parent, component, files_of(component), found)
            add_as_errors(found, report)
            yield place, files


def check_migrated_files(
    plan: MigrationPlan, out: Path, folders: Sequence[Path], report: Report
) -> None:
    """Check the deployments and bridges that were written."""
    found = Report()
    for bridge in plan.bridges:
        check_bdsl(out / bridge, Workspace(folders), found)
    for deployment in plan.deployments:
        check_ddsl(out / deployment, Workspace(folders), found)
    known = {_key(finding) for finding in report}
    report.extend([finding for finding in found if _key(finding) not in known])


def _key(finding: Diagnostic) -> tuple[str, Path, int, str]:
    """What two findings about the same thing have in common."""
    return finding.code.id, finding.span.source.path, finding.span.start, finding.message


def migration_report(
    plan: MigrationPlan, report: Report, format_path: Callable[[Path], str]
) -> OutputFile:
    """`MIGRATION.md`; `format_path` formats the path of an existing file."""
    content = ReportContent(
        plan.name,
        [(moved.name, _outcome(plan, place)) for place, moved in plan.components],
        [*plan.deployments, *plan.bridges],
        [(_old_path(plan, old, format_path), new) for old, new in plan.converted_files],
        sorted(report.sorted(), key=lambda d: d.severity is Severity.NOTE),
        format_path,
        list(_next_steps(plan, report)),
        has_legacy_code=any(f.path.endswith("legacy.py") for f in plan.files),
    )
    return OutputFile(FILE, report_text(content))


def _outcome(plan: MigrationPlan, place: str) -> str:
    """What became of a component's code."""
    before = f"{place}/" if place else ""
    moved = next(component for folder, component in plan.components if folder == place)
    paths = {file.path for file in plan.files}
    if moved.component is None:
        return "its description has errors, so no code was generated"
    if f"{before}specificworker.py" not in paths:
        return "its worker is new and has empty methods"
    return "its worker was carried over"


def _old_path(plan: MigrationPlan, old: str, format_path: Callable[[Path], str]) -> str:
    """The path of an old file of a component; other texts are unchanged."""
    for _, moved in plan.components:
        folder = moved.folder.name
        inner = old if len(plan.components) == 1 else old.removeprefix(f"{folder}/")
        if inner != old or len(plan.components) == 1:
            path = moved.folder / inner
            return format_path(path) if path.is_file() else old
    return old


def _next_steps(plan: MigrationPlan, report: Report) -> Iterator[str]:
    """Commands to run in the new folder, in this order."""
    missing = dict.fromkeys(
        finding.help.rpartition(": ")[2]
        for finding in report
        if finding.code is MISSING_MODULE and finding.help
    )
    yield from missing
    yield "rcgen check ."
    yield from (f"rcgen bridge {bridge}" for bridge in plan.bridges)
    for place, moved in plan.components:
        if moved.component:
            yield f"(cd {shlex.quote(place)} && python3 main.py)" if place else "python3 main.py"
    stand_ins = [f.path for f in plan.files if f.path.startswith(f"{PEERS}/")]
    descriptions = [path for path in stand_ins if path.endswith(".cdsl")]
    if descriptions and plan.components:
        listed = f"for peer in {PEERS}/*/*.cdsl; do rcgen component $peer; done"
        yield f"{listed}  # or import the real ones"
    for deployment in plan.deployments:
        yield f"rcdeploy {deployment} plan"
        yield f"rcdeploy {deployment}"
