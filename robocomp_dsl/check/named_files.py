"""Files that a component names: its parameters and its state machine.

In: a path, relative to the file that it is written in. Out: what the file holds, and findings.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity, nearest
from robocomp_dsl.model.component import StateMachineRef
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax import parse_pdsl
from robocomp_dsl.syntax.ast_base import Text
from robocomp_dsl.syntax.ast_cdsl import StateMachine as Written


def find_beside(
    written: Text, suffixes: tuple[str, ...], beside: Path, workspace: Workspace, report: Report
) -> Path | None:
    """The file of a written path, which is relative to the file `beside` and ends as `suffixes`."""
    path = beside.parent / written.value
    if path.suffix.lower() not in suffixes:
        report.add(
            codes.WRONG_SUFFIX,
            written.span,
            f"`{written.value}` does not end in {' or '.join(f'`{one}`' for one in suffixes)}",
        )
        return None
    if workspace.files.exists(path):
        return path
    near = nearest(path.name, workspace.files.names_in(path.parent))
    guess = str(Path(written.value).parent / near) if near else ""
    report.add(
        codes.MISSING_FILE,
        written.span,
        f"cannot find `{path}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"a path is relative to the folder of `{beside.name}`",
        fix=replace(written.span, f'"{guess}"') if guess else None,
    )
    return None


def parameters_of(
    written: Text | None, beside: Path, workspace: Workspace, report: Report
) -> ParameterSet | None:
    """The parameters in a PDSL file; its errors are added to the report."""
    if written is None:
        return None
    path = find_beside(written, (".pdsl",), beside, workspace, report)
    if path is None:
        return None
    try:
        parsed = workspace.files.parse(path, parse_pdsl)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_IMPORT, written.span, f"cannot read `{path}`: {error}")
        return None
    from robocomp_dsl.check.resolve_pdsl import resolve_pdsl  # noqa: PLC0415 - on first use

    found = Report()
    found.extend(parsed.findings)
    made = resolve_pdsl(parsed, found)
    report.extend(errors_of(found))
    return made


def errors_of(report: Report) -> list[Diagnostic]:
    """What a file that was only named adds to the report of the one that names it."""
    return [one for one in report if one.severity is Severity.ERROR]


def state_machine_of(
    written: Written | None, beside: Path, workspace: Workspace, report: Report
) -> StateMachineRef | None:
    """The state machine of a component, which need not exist yet; its errors are reported."""
    if written is None:
        return None
    path = Path(written.path.value)
    machine = None
    if not workspace.files.exists(beside.parent / path):
        report.add(
            codes.NO_STATE_MACHINE,
            written.path.span,
            f"cannot find the state machine `{beside.parent / path}`",
            help=f"a path is relative to the folder of `{beside.name}`",
        )
    else:
        machine = _machine(written.path, beside, workspace, report)
    return StateMachineRef(path, written.span, machine)


def _machine(
    written: Text, beside: Path, workspace: Workspace, report: Report
) -> StateMachine | None:
    from robocomp_dsl.check.state_machines import MACHINES  # noqa: PLC0415 - on first use

    path = find_beside(written, tuple(MACHINES), beside, workspace, report)
    if path is None:
        return None
    found = Report()
    try:
        made = MACHINES[path.suffix.lower()](path, workspace, found)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_IMPORT, written.span, f"cannot read `{path}`: {error}")
        return None
    report.extend(errors_of(found))
    return made
