"""State machines of either language, from files.

In: the path of a file, whose suffix is one of `MACHINES`. Out: the machine, resolved and judged.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.syntax import ast_innermodel, ast_smdsl, parse_scxml, parse_smdsl


def smdsl_machine(file: Parsed[ast_smdsl.File], report: Report) -> StateMachine | None:
    """The machine of an SMDSL file."""
    from robocomp_dsl.check.resolve_smdsl import resolve_smdsl  # noqa: PLC0415 - on first use
    from robocomp_dsl.check.rules_smdsl import judge_smdsl  # noqa: PLC0415

    resolved = resolve_smdsl(file, report)
    if resolved is None:
        return None
    judge_smdsl(*resolved, report)
    return resolved[0]


def scxml_machine(file: Parsed[ast_innermodel.File], report: Report) -> StateMachine | None:
    """The machine of an SCXML file."""
    from robocomp_dsl.check.resolve_scxml import resolve_scxml  # noqa: PLC0415 - on first use
    from robocomp_dsl.check.rules_states import judge_machine  # noqa: PLC0415

    machine = resolve_scxml(file, report)
    if machine is not None:
        judge_machine(machine, report)
    return machine


def _smdsl(path: Path, workspace: Workspace, report: Report) -> StateMachine | None:
    file = workspace.files.parse(path, parse_smdsl)
    report.extend(file.findings)
    return smdsl_machine(file, report)


def _scxml(path: Path, workspace: Workspace, report: Report) -> StateMachine | None:
    file = workspace.files.parse(path, parse_scxml)
    report.extend(file.findings)
    return scxml_machine(file, report)


MACHINES: dict[str, Callable[[Path, Workspace, Report], StateMachine | None]] = {
    ".smdsl": _smdsl,
    ".scxml": _scxml,
}
"""File suffix (lower case) to machine; each raises `UnreadableSource`."""
