"""Checks state machines of SMDSL and SCXML.

In: the path of a file, whose suffix is one of `MACHINES`. Out: the resolved and checked machine.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.causes import report_causes
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.statemachine import StateMachine
from robocomp_dsl.syntax.ast import innermodel, smdsl
from robocomp_dsl.syntax.parse import parse_scxml, parse_smdsl


def smdsl_machine(file: Parsed[smdsl.File], report: Report) -> StateMachine | None:
    """The machine of an SMDSL file."""
    from robocomp_dsl.check.states.resolve_smdsl import resolve_smdsl  # noqa: PLC0415 - on first use
    from robocomp_dsl.check.states.rules_smdsl import check_smdsl_rules  # noqa: PLC0415

    def resolve(file: Parsed[smdsl.File], report: Report) -> StateMachine | None:
        resolved = resolve_smdsl(file, report)
        if resolved is None:
            return None
        check_smdsl_rules(*resolved, report)
        return resolved[0]

    machine = resolve(file, report)
    report_causes(report, file, parse_smdsl, resolve)
    return machine


def scxml_machine(file: Parsed[innermodel.File], report: Report) -> StateMachine | None:
    """The machine of an SCXML file."""
    from robocomp_dsl.check.states.eventless_cycles import check_eventless_cycles  # noqa: PLC0415
    from robocomp_dsl.check.states.resolve_scxml import resolve_scxml  # noqa: PLC0415 - on first use
    from robocomp_dsl.check.states.rules import check_machine_rules  # noqa: PLC0415

    machine = resolve_scxml(file, report)
    if machine is not None:
        check_machine_rules(machine, report)
        check_eventless_cycles(machine, report)
    return machine


def _smdsl(path: Path, workspace: Workspace, report: Report) -> StateMachine | None:
    file = workspace.sources.parse(path, parse_smdsl)
    report.extend(file.diagnostics)
    return smdsl_machine(file, report)


def _scxml(path: Path, workspace: Workspace, report: Report) -> StateMachine | None:
    file = workspace.sources.parse(path, parse_scxml)
    report.extend(file.diagnostics)
    return scxml_machine(file, report)


MACHINES: dict[str, Callable[[Path, Workspace, Report], StateMachine | None]] = {
    ".smdsl": _smdsl,
    ".scxml": _scxml,
}
"""File suffix (lower case) to machine; each raises `UnreadableSource`."""
