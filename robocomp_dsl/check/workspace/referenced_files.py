"""Files that a component references: its parameters and its state machine.

In: a path, relative to the referencing file. Out: the model of the file, and diagnostics.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report, Severity, nearest
from robocomp_dsl.model.component import StateMachineRef
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast.base import Text
from robocomp_dsl.syntax.ast.cdsl import StateMachine as Written
from robocomp_dsl.syntax.parse import parse_pdsl


def find_referenced_file(
    written: Text, suffixes: tuple[str, ...], beside: Path, workspace: Workspace, report: Report
) -> Path | None:
    """The file at a path relative to the file `beside`; its suffix must be one of `suffixes`.

    An empty suffix is that of a name without a dot.
    """
    path = beside.parent / written.value
    if path.suffix.lower() not in suffixes:
        report.add(
            codes.WRONG_SUFFIX,
            written.span,
            f"`{written.value}` does not end in"
            f" {' or '.join(f'`{end}`' for end in suffixes if end)}",
        )
        return None
    if workspace.sources.exists(path):
        return path
    near = nearest(path.name, workspace.sources.names_in(path.parent))
    guess = str(Path(written.value).parent / near) if near else ""
    report.add(
        codes.MISSING_FILE,
        written.span,
        f"cannot find `{path}`",
        label=f"did you mean `{guess}`?" if guess else "",
        help=f"a path is relative to the folder of `{beside.name}`",
        fix=replace_fix(written.span, f'"{guess}"') if guess else None,
    )
    return None


def parameters_of(
    written: Text | None, beside: Path, workspace: Workspace, report: Report
) -> ParameterSet | None:
    """The parameters in a PDSL file; its errors are added to the report."""
    if written is None:
        return None
    path = find_referenced_file(written, (".pdsl",), beside, workspace, report)
    if path is None:
        return None
    try:
        parsed = workspace.sources.parse(path, parse_pdsl)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_IMPORT, written.span, f"cannot read `{path}`: {error}")
        return None
    from robocomp_dsl.check.pdsl.resolve import resolve_pdsl  # noqa: PLC0415 - on first use

    file_report = Report()
    file_report.extend(parsed.diagnostics)
    parameters = resolve_pdsl(parsed, file_report)
    report.extend(errors_of(file_report))
    return parameters


def errors_of(report: Report) -> list[Diagnostic]:
    """The diagnostics of a referenced file that are reported with the referencing file."""
    return [diagnostic for diagnostic in report if diagnostic.severity is Severity.ERROR]


def state_machine_of(
    written: Written | None, beside: Path, workspace: Workspace, report: Report
) -> StateMachineRef | None:
    """The state machine of a component; its file need not exist yet. Its errors are reported."""
    if written is None:
        return None
    path = Path(written.path.value)
    machine = None
    if not workspace.sources.exists(beside.parent / path):
        report.add(
            codes.NO_STATE_MACHINE,
            written.path.span,
            f"cannot find the state machine `{beside.parent / path}`",
            help=f"the component is generated without it; a path is relative to the folder of"
            f" `{beside.name}`",
        )
    else:
        machine = _machine(written.path, beside, workspace, report)
    return StateMachineRef(path, written.span, machine)


def _machine(
    written: Text, beside: Path, workspace: Workspace, report: Report
) -> StateMachine | None:
    from robocomp_dsl.check.states.state_machines import MACHINES  # noqa: PLC0415 - on first use

    path = find_referenced_file(written, tuple(MACHINES), beside, workspace, report)
    if path is None:
        return None
    file_report = Report()
    try:
        machine = MACHINES[path.suffix.lower()](path, workspace, file_report)
    except UnreadableSource as error:
        report.add(codes.UNREADABLE_IMPORT, written.span, f"cannot read `{path}`: {error}")
        return None
    report.extend(errors_of(file_report))
    return machine
