"""What follows when the files are there: generation, a last check, and the report.

In: the plan and the folder it was written to. Out: more files, and findings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check import check_cdsl, check_ddsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.generate import plan as files_of
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.upkeep import keep_up
from robocomp_dsl.migrate import Plan
from robocomp_dsl.migrate.record import FILE, record_text


def generated(
    plan: Plan, out: Path, folders: Sequence[Path], report: Report
) -> Iterator[tuple[str, list[OutputFile]]]:
    """For each component its folder and what `rcgen component` makes there."""
    for place, moved in plan.components:
        path = out / place / moved.description
        component = check_cdsl(path, Workspace(folders), report)
        if moved.component is not None and component is not None:
            yield place, keep_up(path.parent, component, files_of(component), report)


def judged(plan: Plan, out: Path, folders: Sequence[Path], report: Report) -> None:
    """Check the deployment."""
    if plan.deployment:
        check_ddsl(out / plan.deployment, Workspace(folders), report)


def recorded(plan: Plan, report: Report, shown: Callable[[Path], str]) -> OutputFile:
    """`MIGRATION.md`."""
    findings = sorted(report.sorted(), key=lambda d: d.severity is Severity.NOTE)
    steps = [f"rcgen check {place or '.'}" for place, _ in plan.components]
    started = [place for place, moved in plan.components if moved.component]
    steps += [f"(cd {p} && python3 main.py)" if p else "python3 main.py" for p in started]
    if plan.deployment:
        steps += [f"rcdeploy {plan.deployment} plan", f"rcdeploy {plan.deployment}"]
    code = any(f.path.endswith("legacy.py") for f in plan.files)
    text = record_text(plan.name, plan.became, findings, shown, steps, code=code)
    return OutputFile(FILE, text)
