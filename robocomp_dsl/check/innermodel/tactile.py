"""Checks tactile descriptions: generic parts, limbs and skin in YAML, or a part in the paper's XML.

In: the path of a file. Out: diagnostics about the file, and about the joints, bodies and geometry
of the model that it names. The readers are in `robocomp_dsl.tactile.description`, because running
components use them too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from robocomp_dsl.check.codes import tactile as codes
from robocomp_dsl.check.innermodel.resolve import resolve_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.finding import Finding
from robocomp_dsl.model import innermodel as nouns
from robocomp_dsl.model.innermodel import InnerModel
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.source import Source, UnreadableSource
from robocomp_dsl.tactile.description.check import RobotStructure, compare
from robocomp_dsl.tactile.description.coverage import unanswered_taxels
from robocomp_dsl.tactile.description.geometry.check_geometry import check_geometry
from robocomp_dsl.tactile.description.geometry.posed_model import PosedModel
from robocomp_dsl.tactile.description.model import RobotDescription
from robocomp_dsl.tactile.description.part_xml import read_part_xml
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import DescriptionError, Fault

CODES: dict[str, Code] = {
    Fault.FORM: codes.TACTILE_SYNTAX,
    Fault.JOINT: codes.TACTILE_JOINT,
    Fault.LIMITS: codes.TACTILE_LIMITS,
    Fault.BODY: codes.TACTILE_BODY,
    Fault.OFF_BODY: codes.TAXELS_OFF_SURFACE,
    Fault.TWICE: codes.TACTILE_DUPLICATE,
    Fault.FRAME: codes.TACTILE_FRAME,
    Fault.DIRECTION: codes.TACTILE_DIRECTION,
    Fault.CHAIN: codes.TACTILE_CHAIN,
    Fault.SURFACE: codes.TACTILE_SURFACE,
    Fault.UNANSWERED: codes.TAXELS_UNANSWERED,
}
_PARTS = re.compile(r"^parts\s*:", re.MULTILINE)
_MODELS = (b"mujoco", b"robot")


def check_robot(source: Source, report: Report) -> RobotDescription | None:
    """The robot that a YAML text describes; None if the text has errors."""
    if not _PARTS.search(source.text):
        message = f"`{source.path.name}` has no `parts`: it is not a tactile description"
        help_text = "the configuration of a component is checked when the component starts"
        report.add(codes.TACTILE_SYNTAX, source.span(0, 0), message, help=help_text)
        return None
    try:
        robot = read_robot(source.text, source.path)
    except DescriptionError as error:
        report_findings(error.findings, source, report)
        return None
    report_findings(unanswered_taxels(robot), source, report)
    return robot


def check_part(source: Source, report: Report) -> None:
    """Check a generic part in XML."""
    try:
        read_part_xml(source.text, source.path)
    except DescriptionError as error:
        report_findings(error.findings, source, report)


def check_against_model(
    robot: RobotDescription, source: Source, workspace: Workspace, report: Report
) -> None:
    """Check the description against the robot model that it names."""
    try:
        structure, model = _structure(robot, workspace)
    except _ModelUnavailable as error:
        finding = Finding(robot.model_place, str(error))
        report.add_finding(codes.TACTILE_MODEL, finding, source)
        return
    fits = check_against_structure(robot, structure, source, report)
    if fits and model:
        report_findings(check_geometry(robot, model), source, report)


def check_against_structure(
    robot: RobotDescription, structure: RobotStructure, source: Source, report: Report
) -> bool:
    """Check the description against joints and bodies; returns whether all of them exist."""
    try:
        compare(robot, structure)
    except DescriptionError as error:
        report_findings(error.findings, source, report)
        return all(finding.kind == Fault.LIMITS for finding in error.findings)
    return True


class _ModelUnavailable(Exception):
    """The model cannot be loaded; the message says why."""


def _structure(
    robot: RobotDescription, workspace: Workspace
) -> tuple[RobotStructure, PosedModel | None]:
    """The joints and bodies of the model; of MJCF and URDF also its geometry."""
    path = robot.file.parent / robot.model
    try:
        head = read_bytes(path)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise _ModelUnavailable(f"`{robot.model}` cannot be read: {why}") from None
    if not re.search(rb"<\s*innermodel\b", head, re.IGNORECASE):
        return _simulated(path, robot.model)
    try:
        return _described(resolve_innermodel(path, workspace.sources, Report())), None
    except UnreadableSource:  # reported when the model itself is checked
        return RobotStructure({}, frozenset()), None


def _described(body: InnerModel) -> RobotStructure:
    nodes = [node for node, _ in body.nodes()]
    turning = (nouns.Joint, nouns.PrismaticJoint)
    joints = {node.id: (node.min, node.max) for node in nodes if isinstance(node, turning)}
    return RobotStructure(joints, frozenset(node.id for node in nodes))


def _simulated(path: Path, name: str) -> tuple[RobotStructure, PosedModel]:
    """The joints and bodies of an MJCF or URDF file, loaded with MuJoCo."""
    try:
        from robocomp_dsl.hardware.description.findings import ModelFileError  # noqa: PLC0415 - slow
        from robocomp_dsl.simulation.models.posed_model import MujocoPosedModel  # noqa: PLC0415
    except ImportError as missing:
        raise _ModelUnavailable(f"`{name}` cannot be loaded without MuJoCo: {missing}") from None
    try:
        model = MujocoPosedModel(path)
    except (ModelFileError, OSError) as error:
        raise _ModelUnavailable(f"`{name}` is not a valid model: {error}") from None
    return RobotStructure(model.joint_ranges, model.body_names), model


def report_findings(findings: Iterable[Finding], source: Source, report: Report) -> None:
    """Report findings about `source` and the taxel position files that it names."""
    for finding in findings:
        file = finding.location.file
        about = source if file == str(source.path) else _opened(Path(file))
        report.add_finding(CODES[finding.kind], finding, about)


def _opened(path: Path) -> Source:
    try:
        return Source.read(path)
    except UnreadableSource:  # deleted in the meantime
        return Source(path, "")
