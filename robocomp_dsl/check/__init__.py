"""The checks: from files to judged models. This page lists the passes; read it first.

In: the path of a file, a `Workspace` (unsaved buffers win over the disk) and a `Report`. Out: the
model of the file, with what could be understood, and in the report everything that was found:
about the file itself all, about the files that it mentions the errors.

    language  tree          names get their meaning   what a model may not say
    IDSL      parse_idsl    resolve_idsl              rules_idsl               by `Library.load`
    CDSL      parse_cdsl    resolve_cdsl              rules_cdsl               `check_cdsl`
    PDSL      parse_pdsl    resolve_pdsl              rules_pdsl               `check_pdsl`
    DDSL      parse_ddsl    resolve_ddsl              in its parts             `check_ddsl`
    SMDSL     parse_smdsl   resolve_smdsl             rules_smdsl, rules_states `check_machine`
    SCXML     parse_scxml   scxml_form, resolve_scxml rules_states             `check_machine`
    InnerModel              resolve_innermodel        rules_innermodel         `check_innermodel`
    generic parts and skin, in YAML or XML            `tactile`                `check_tactile`

The parts of a DDSL file: `components`, `instances`, `settings`, `order`, `wiring`, `implied_wires`.

Every pass goes on after an error, so one run shows all of them. Nothing here raises because of what
a file says. `files`, `search` and `library` keep what did not change since the last run.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from robocomp_dsl.check import codes
from robocomp_dsl.check.files import Parsed, Parser
from robocomp_dsl.check.loaded import errors_behind
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.syntax import (
    LANGUAGES,
    parse_cdsl,
    parse_ddsl,
    parse_innermodel,
    parse_pdsl,
    parse_scxml,
)
from robocomp_dsl.syntax import (
    codes as form,
)

if TYPE_CHECKING:  # what a run does not need is not loaded: see the imports in the functions
    from robocomp_dsl.model.body import Body
    from robocomp_dsl.model.component import Component
    from robocomp_dsl.model.deployment import Deployment
    from robocomp_dsl.model.interface import Module
    from robocomp_dsl.model.parameter import ParameterSet
    from robocomp_dsl.model.statemachine import StateMachine

    Model: TypeAlias = (
        tuple[Module, ...] | Component | ParameterSet | Deployment | StateMachine | Body
    )
    Check: TypeAlias = Callable[[Path, Workspace, Report], Model | None]

Tree = TypeVar("Tree")


def check_file(path: Path, workspace: Workspace, report: Report) -> Model | None:
    """The model of any file; its suffix says which language it is written in."""
    if _tells_touch(path):
        check_tactile(path, workspace, report)
        return None
    check = CHECKS.get(path.suffix.lower())
    if check is None:
        _report_language(path, report)
        return None
    return check(path, workspace, report)


def check_syntax(path: Path, workspace: Workspace, report: Report) -> None:
    """Judge the form of a file only; no import is followed."""
    parser = PARSERS.get(path.suffix.lower())
    if _tells_touch(path):
        check_tactile(path, workspace, report, alone=True)
    elif parser is None:
        _report_language(path, report)
    else:
        _parsed(path, parser, workspace, report)


def check_idsl(path: Path, workspace: Workspace, report: Report) -> tuple[Module, ...] | None:
    """The modules of an interface description (legacy files may have several)."""
    workspace.library.begin(path)
    try:
        loaded = workspace.library.load(path)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None
    report.extend(loaded.findings)
    report.extend(errors_behind(loaded.links))
    return loaded.modules


def check_cdsl(path: Path, workspace: Workspace, report: Report) -> Component | None:
    """The component of a component description."""
    from robocomp_dsl.check.resolve_cdsl import resolve_cdsl  # noqa: PLC0415 - on first use
    from robocomp_dsl.check.rules_cdsl import judge_cdsl  # noqa: PLC0415

    workspace.library.begin(path)
    file = _parsed(path, parse_cdsl, workspace, report)
    if file is None or file.tree.component is None:
        return None
    resolved = resolve_cdsl(file, file.tree.component, workspace, report)
    judge_cdsl(file.tree.component, resolved, report)
    return resolved.component


def check_pdsl(path: Path, workspace: Workspace, report: Report) -> ParameterSet | None:
    """The parameters of a parameter description."""
    from robocomp_dsl.check.resolve_pdsl import resolve_pdsl  # noqa: PLC0415

    file = _parsed(path, parse_pdsl, workspace, report)
    return resolve_pdsl(file, report) if file else None


def check_ddsl(path: Path, workspace: Workspace, report: Report) -> Deployment | None:
    """The deployment of a deployment description."""
    from robocomp_dsl.check.resolve_ddsl import resolve_ddsl  # noqa: PLC0415

    file = _parsed(path, parse_ddsl, workspace, report)
    return resolve_ddsl(file, workspace, check_cdsl, report) if file else None


def check_machine(path: Path, workspace: Workspace, report: Report) -> StateMachine | None:
    """The state machine of an SMDSL or SCXML file."""
    from robocomp_dsl.check.state_machines import MACHINES  # noqa: PLC0415

    try:
        return MACHINES[path.suffix.lower()](path, workspace, report)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None


def check_innermodel(path: Path, workspace: Workspace, report: Report) -> Body | None:
    """The body of an InnerModel file, with all that it includes."""
    from robocomp_dsl.check.resolve_innermodel import resolve_innermodel  # noqa: PLC0415
    from robocomp_dsl.check.rules_innermodel import judge_innermodel  # noqa: PLC0415

    try:
        body = resolve_innermodel(path, workspace.files, report)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None
    judge_innermodel(body, report)
    return body


def check_tactile(path: Path, workspace: Workspace, report: Report, *, alone: bool = False) -> None:
    """A description of generic parts and skin; `alone`: without the model that it names."""
    from robocomp_dsl.check import tactile  # noqa: PLC0415 - numpy and YAML

    try:
        source = workspace.files.read(path)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return
    if path.suffix.lower() == ".xml":
        tactile.judge_part(source, report)
        return
    robot = tactile.judge_robot(source, report)
    if robot and robot.model and not alone:
        tactile.judge_model(robot, source, workspace, report)


def _tells_touch(path: Path) -> bool:
    """Whether the file is YAML, or XML of one generic part."""
    if path.suffix.lower() != ".xml":
        return path.suffix.lower() in TACTILE
    try:
        with path.open("rb") as file:
            return b"<Generic_Robot_Part" in file.read(_HEAD)
    except OSError:
        return False


CHECKS: Mapping[str, Check] = {
    ".idsl": check_idsl,
    ".cdsl": check_cdsl,
    ".pdsl": check_pdsl,
    ".ddsl": check_ddsl,
    ".smdsl": check_machine,
    ".scxml": check_machine,
    ".xml": check_innermodel,
}
"""File suffix (lower case) to all passes of its language."""

TACTILE = (".yaml", ".yml")
"""Suffixes of descriptions of touch, which are no language of their own."""

_HEAD = 4096

PARSERS: Mapping[str, Callable[[Source, Report], object]] = {
    **LANGUAGES,
    ".scxml": parse_scxml,
    ".xml": parse_innermodel,
}


def _parsed(
    path: Path, parser: Parser[Tree], workspace: Workspace, report: Report
) -> Parsed[Tree] | None:
    try:
        file = workspace.files.parse(path, parser)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None
    report.extend(file.findings)
    return file


def _report_unreadable(path: Path, error: UnreadableSource, report: Report) -> None:
    report.add(form.UNREADABLE, Source(path, "").whole, f"cannot read `{path}`: {error}")


def _report_language(path: Path, report: Report) -> None:
    known = ", ".join(f"`{suffix}`" for suffix in (*CHECKS, TACTILE[0]))
    report.add(
        codes.UNKNOWN_SUFFIX,
        Source(path, "").whole,
        f"cannot tell the language of `{path}`",
        help=f"the name of a file ends in one of {known}",
    )
