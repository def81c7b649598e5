"""Descriptions of touch: generic parts, limbs and skin in YAML, or a part in the XML of the paper.

In: the path of a file. Out: nothing but findings: with itself, and with the joints and bodies of
the model that it names. What reads descriptions is in `robocomp_dsl.tactile.description`, where a
running component finds it too.
"""

from __future__ import annotations

import re
from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import body as nouns
from robocomp_dsl.model.body import Body
from robocomp_dsl.source import Source, Span, UnreadableSource
from robocomp_dsl.tactile.description.check import Facts, compare
from robocomp_dsl.tactile.description.listing import read_listing
from robocomp_dsl.tactile.description.model import Robot
from robocomp_dsl.tactile.description.read import read_robot
from robocomp_dsl.tactile.errors import DescriptionError, Fault, Finding

CODES = {
    Fault.FORM: codes.TACTILE_FORM,
    Fault.JOINT: codes.TACTILE_JOINT,
    Fault.LIMITS: codes.TACTILE_LIMITS,
    Fault.BODY: codes.TACTILE_BODY,
    Fault.OFF_BODY: codes.TAXELS_OFF_BODY,
    Fault.TWICE: codes.TACTILE_TWICE,
}
_WORD = re.compile(r"[^\s,:{}\[\]<>]*")
_PARTS = re.compile(r"^parts\s*:", re.MULTILINE)
_MODELS = (b"mujoco", b"robot")


def judge_robot(source: Source, report: Report) -> Robot | None:
    """The robot that a YAML text describes, judged by itself; None for one with errors."""
    if not _PARTS.search(source.text):
        said = f"`{source.path.name}` has no `parts`: it does not describe generic parts"
        way = "the configuration of a component is checked when the component starts"
        report.add(codes.TACTILE_FORM, source.span(0, 0), said, help=way)
        return None
    try:
        return read_robot(source.text, source.path)
    except DescriptionError as error:
        tell(error, source, report)
        return None


def judge_part(source: Source, report: Report) -> None:
    """A generic part in XML."""
    try:
        read_listing(source.text, source.path)
    except DescriptionError as error:
        tell(error, source, report)


def judge_model(robot: Robot, source: Source, workspace: Workspace, report: Report) -> None:
    """Against the model that it names."""
    try:
        judge_facts(robot, _facts(robot, workspace), source, report)
    except _NoModel as error:
        place = Finding("", robot.model_place.line, robot.model_place.column, "")
        report.add(codes.TACTILE_MODEL, _span(place, source), str(error))


def judge_facts(robot: Robot, facts: Facts, source: Source, report: Report) -> None:
    """Against the joints and bodies that are there."""
    try:
        compare(robot, facts)
    except DescriptionError as error:
        tell(error, source, report)


class _NoModel(Exception):
    """The model cannot be had; the message says why."""


def _facts(robot: Robot, workspace: Workspace) -> Facts:
    path = robot.file.parent / robot.model
    try:
        head = path.read_bytes()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise _NoModel(f"`{robot.model}` cannot be read: {why}") from None
    if not re.search(rb"<\s*innermodel\b", head, re.IGNORECASE):
        return _simulated(path, robot.model)
    from robocomp_dsl.check import check_innermodel  # noqa: PLC0415 - which imports this

    body = check_innermodel(path, workspace, Report())
    return _described(body) if body else Facts({}, frozenset())


def _described(body: Body) -> Facts:
    nodes = [node for node, _ in body.nodes()]
    turning = (nouns.Joint, nouns.PrismaticJoint)
    joints = {node.id: (node.min, node.max) for node in nodes if isinstance(node, turning)}
    return Facts(joints, frozenset(node.id for node in nodes))


def _simulated(path: Path, name: str) -> Facts:
    """Of MJCF and URDF, as MuJoCo reads them."""
    try:
        from robocomp_dsl.hardware.findings import ModelFileError  # noqa: PLC0415 - slow
        from robocomp_dsl.hardware.mujoco.model_file import load_model  # noqa: PLC0415
    except ImportError as missing:
        raise _NoModel(f"`{name}` needs MuJoCo to be read: {missing}") from None
    try:
        model = load_model(path).model
    except (ModelFileError, OSError) as error:
        raise _NoModel(f"`{name}` is no model: {error}") from None
    joints = {}
    for i in range(model.njnt):
        free = not model.jnt_limited[i]
        low, high = (-float("inf"), float("inf")) if free else model.jnt_range[i]
        joints[model.joint(i).name] = (float(low), float(high))
    return Facts(joints, frozenset(model.body(i).name for i in range(1, model.nbody)))


def tell(error: DescriptionError, source: Source, report: Report) -> None:
    """Report what is wrong with `source`, and with the files of positions that it names."""
    for one in error.findings:
        at = source if one.file == str(source.path) else _opened(Path(one.file))
        report.add(CODES[one.fault], _span(one, at), one.message, help=one.help)


def _opened(path: Path) -> Source:
    try:
        return Source.read(path)
    except UnreadableSource:  # it was there a moment ago
        return Source(path, "")


def _span(found: Finding, source: Source) -> Span:
    """The word at a place, or the rest of its line."""
    lines = source.line_starts
    start = min(lines[min(found.line, len(lines)) - 1] + found.column - 1, len(source.text))
    word = _WORD.match(source.text, start)
    end = word.end() if word and word.end() > start else _end_of_line(source.text, start)
    return source.span(start, max(end, start))


def _end_of_line(text: str, start: int) -> int:
    end = text.find("\n", start)
    return len(text) if end < 0 else end
