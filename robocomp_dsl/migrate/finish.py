"""The last stages of a migration: generation, a final check, and the report.

In: the plan and its output folder. Out: more files, and findings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check.passes import check_bdsl, check_cdsl, check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.plan import plan as files_of
from robocomp_dsl.generate.regeneration.update import update_user_files
from robocomp_dsl.migrate.migration import MigrationPlan
from robocomp_dsl.migrate.migration_report import FILE, report_text


def generate_components(
    plan: MigrationPlan, out: Path, folders: Sequence[Path], report: Report
) -> Iterator[tuple[str, list[OutputFile]]]:
    """For each component, its folder and the files that `rcgen component` generates there."""
    for place, moved in plan.components:
        path = out / place / moved.description
        component = check_cdsl(path, Workspace(folders), report)
        if moved.component is not None and component is not None:
            yield place, update_user_files(path.parent, component, files_of(component), report)


def check_migrated_files(
    plan: MigrationPlan, out: Path, folders: Sequence[Path], report: Report
) -> None:
    """Check the deployments and bridges that were written."""
    for bridge in plan.bridges:
        check_bdsl(out / bridge, Workspace(folders), report)
    for deployment in plan.deployments:
        check_ddsl(out / deployment, Workspace(folders), report)


def migration_report(
    plan: MigrationPlan, report: Report, format_path: Callable[[Path], str]
) -> OutputFile:
    """`MIGRATION.md`."""
    findings = sorted(report.sorted(), key=lambda d: d.severity is Severity.NOTE)
    steps = [f"rcgen check {place or '.'}" for place, _ in plan.components]
    steps += [f"rcgen bridge {bridge}" for bridge in plan.bridges]
    started = [place for place, moved in plan.components if moved.component]
    steps += [f"(cd {p} && python3 main.py)" if p else "python3 main.py" for p in started]
    for deployment in plan.deployments:
        steps += [f"rcdeploy {deployment} plan", f"rcdeploy {deployment}"]
    has_legacy_code = any(f.path.endswith("legacy.py") for f in plan.files)
    text = report_text(
        plan.name,
        plan.converted_files,
        findings,
        format_path,
        steps,
        has_legacy_code=has_legacy_code,
    )
    return OutputFile(FILE, text)
