"""The passes of each language, as functions from a file to its model.

In: a path, a `Workspace` and a `Report`. Out: the model, as far as the file could be understood.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from robocomp_dsl.check.causes import report_causes
from robocomp_dsl.check.workspace.loaded import transitive_errors
from robocomp_dsl.check.workspace.source_cache import Parsed, Parser
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.syntax.codes import file as form
from robocomp_dsl.syntax.parse import parse_bdsl, parse_cdsl, parse_ddsl, parse_pdsl

if TYPE_CHECKING:  # start-up time: modules are imported in the functions that need them
    from robocomp_dsl.model.bridge import Bridge
    from robocomp_dsl.model.component import Component
    from robocomp_dsl.model.deployment import Deployment
    from robocomp_dsl.model.innermodel import InnerModel
    from robocomp_dsl.model.interface import Module
    from robocomp_dsl.model.parameter import ParameterSet
    from robocomp_dsl.model.statemachine import StateMachine
    from robocomp_dsl.syntax.ast import bdsl, cdsl, ddsl

Tree = TypeVar("Tree")


def check_idsl(path: Path, workspace: Workspace, report: Report) -> tuple[Module, ...] | None:
    """The modules of an interface description (legacy files may have several)."""
    workspace.modules.start_run(path)
    try:
        loaded = workspace.modules.load(path)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None
    report.extend(loaded.diagnostics)
    report.extend(transitive_errors(loaded.imports))
    return loaded.modules


def check_cdsl(path: Path, workspace: Workspace, report: Report) -> Component | None:
    """The component of a component description."""
    from robocomp_dsl.check.cdsl.resolve import resolve_cdsl  # noqa: PLC0415 - on first use
    from robocomp_dsl.check.cdsl.rules import check_cdsl_rules  # noqa: PLC0415

    workspace.modules.start_run(path)
    file = parse(path, parse_cdsl, workspace, report)
    if file is None or file.tree.component is None:
        return None

    def resolve(file: Parsed[cdsl.File], report: Report) -> Component | None:
        tree = file.tree.component
        if tree is None:
            return None
        resolved = resolve_cdsl(file, tree, workspace, report)
        check_cdsl_rules(resolved, report)
        if tree.gui:
            from robocomp_dsl.check.cdsl.window import check_form  # noqa: PLC0415 - for windows

            check_form(tree.gui, path.parent, workspace, report)
        return resolved.component

    component = resolve(file, report)
    report_causes(report, file, parse_cdsl, resolve)
    return component


def check_pdsl(path: Path, workspace: Workspace, report: Report) -> ParameterSet | None:
    """The parameters of a parameter description."""
    from robocomp_dsl.check.pdsl.resolve import resolve_pdsl  # noqa: PLC0415

    file = parse(path, parse_pdsl, workspace, report)
    return resolve_pdsl(file, report) if file else None


def check_ddsl(path: Path, workspace: Workspace, report: Report) -> Deployment | None:
    """The deployment of a deployment description."""
    from robocomp_dsl.check.ddsl.resolve import resolve_ddsl  # noqa: PLC0415

    file = parse(path, parse_ddsl, workspace, report)
    if file is None:
        return None

    def resolve(file: Parsed[ddsl.File], report: Report) -> Deployment | None:
        return resolve_ddsl(file, workspace, check_cdsl, report)

    deployment = resolve(file, report)
    report_causes(report, file, parse_ddsl, resolve)
    return deployment


def check_bdsl(path: Path, workspace: Workspace, report: Report) -> Bridge | None:
    """The bridge of a bridge description."""
    from robocomp_dsl.check.bdsl.resolve import resolve_bdsl  # noqa: PLC0415

    workspace.modules.start_run(path)
    file = parse(path, parse_bdsl, workspace, report)
    if file is None or file.tree.bridge is None:
        return None

    def resolve(file: Parsed[bdsl.File], report: Report) -> Bridge | None:
        tree = file.tree.bridge
        return resolve_bdsl(file, tree, workspace, report) if tree else None

    bridge = resolve(file, report)
    report_causes(report, file, parse_bdsl, resolve)
    return bridge


def check_state_machine(path: Path, workspace: Workspace, report: Report) -> StateMachine | None:
    """The state machine of an SMDSL or SCXML file."""
    from robocomp_dsl.check.states.state_machines import MACHINES  # noqa: PLC0415

    try:
        return MACHINES[path.suffix.lower()](path, workspace, report)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None


def check_innermodel(path: Path, workspace: Workspace, report: Report) -> InnerModel | None:
    """The InnerModel of a file, with all included files."""
    from robocomp_dsl.check.innermodel.resolve import resolve_innermodel  # noqa: PLC0415
    from robocomp_dsl.check.innermodel.rules import check_innermodel_rules  # noqa: PLC0415

    try:
        body = resolve_innermodel(path, workspace.sources, report)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None
    check_innermodel_rules(body, report)
    if workspace.world_folders is not None:
        from robocomp_dsl.check.innermodel.world_files import check_world_files  # noqa: PLC0415

        check_world_files(body, workspace.world_folders, report)
    return body


def check_model_file(path: Path, workspace: Workspace, report: Report) -> None:
    """Check a model of a robot, URDF or MJCF, by itself."""
    from robocomp_dsl.check.model_file.check_model import check_model  # noqa: PLC0415

    try:
        workspace.sources.read(path)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return
    check_model(path, report)


def check_tactile(
    path: Path, workspace: Workspace, report: Report, *, syntax_only: bool = False
) -> None:
    """Check a tactile description; `syntax_only`: not against the robot model that it names."""
    from robocomp_dsl.check.innermodel import tactile  # noqa: PLC0415 - numpy and YAML

    try:
        source = workspace.sources.read(path)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return
    if path.suffix.lower() == ".xml":
        tactile.check_part(source, report)
        return
    robot = tactile.check_robot(source, report)
    if robot and robot.model and not syntax_only:
        tactile.check_against_model(robot, source, workspace, report)


def parse(
    path: Path, parser: Parser[Tree], workspace: Workspace, report: Report
) -> Parsed[Tree] | None:
    """The tree of a file, with its syntax errors in the report; None if it cannot be read."""
    try:
        file = workspace.sources.parse(path, parser)
    except UnreadableSource as error:
        _report_unreadable(path, error, report)
        return None
    report.extend(file.diagnostics)
    return file


def _report_unreadable(path: Path, error: UnreadableSource, report: Report) -> None:
    report.add(form.UNREADABLE, Source(path, "").file_span, f"cannot read `{path}`: {error}")
