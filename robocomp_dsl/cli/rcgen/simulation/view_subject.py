"""Loads the subject of `rcgen view`: a file in InnerModel, URDF or MJCF, or a shipped robot.

In: the user's argument. Out: a compiled model, and findings with locations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.check.codes import model_files as codes
from robocomp_dsl.check.model_file.model_findings import (
    code_of,
    read_source,
    report_error,
    report_findings,
)
from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.finding import Finding
from robocomp_dsl.generate.scene.scene import lower_body
from robocomp_dsl.generate.scene.scene_files import resolve_files
from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.hardware.description.model_kind import MODELS, root_tag
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.description.world_files import FileSearch
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.simulation.models.model_file import compiled, read_spec
from robocomp_dsl.simulation.models.model_state import initial_data
from robocomp_dsl.simulation.robots.build import add_robot, new_world
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.scene.scene_devices import place_cameras
from robocomp_dsl.simulation.scene.scene_spec import build_spec
from robocomp_dsl.simulation.view.picture import add_lighting
from robocomp_dsl.simulation.world.limits import clamp_scene
from robocomp_dsl.source import Source, Span


@dataclass(frozen=True, slots=True)
class Subject:
    """`start` has the initial joint positions by name, if they are not 0.

    A model file starts at the first of its key frames.
    """

    name: str
    model: Any
    start: dict[str, float]

    def data(self) -> Any:
        """Its initial state, an `MjData`."""
        return initial_data(self.model, self.start)


def read_subject(
    path: Path, packages: Sequence[Path], report: Report, world_folders: Sequence[Path] = ()
) -> Subject | None:
    """The model that `path` names; None if no part of it is valid."""
    if not path.exists() and str(path) in ROBOTS:
        return _robot(str(path))
    try:
        data = read_bytes(path)
    except OSError as error:
        message = f"`{path}` cannot be read: {error.strerror or error}"
        report.add(codes.MODEL_FILE, Source(path, "").file_span, message)
        return None
    if root_tag(data) in MODELS:
        return _model(path, packages, report)
    return _world(path, world_folders, report)


def _robot(name: str) -> Subject:
    robot = ROBOTS[name]()
    spec = new_world()
    add_robot(spec, robot)
    add_lighting(spec)
    return Subject(name, spec.compile(), dict(robot.start))


def _model(path: Path, packages: Sequence[Path], report: Report) -> Subject | None:
    source = read_source(path)
    try:
        spec, findings = read_spec(path, packages)
        add_lighting(spec)
        model = compiled(spec, findings)
    except ModelFileError as error:
        report_error(error, source, report)
        return None
    report_findings(findings, source, report)
    return Subject(path.stem, model, {})


def _world(path: Path, world_folders: Sequence[Path], report: Report) -> Subject | None:
    """The model of a world; errors are reported, and the valid part is shown."""
    body = check_innermodel(path, Workspace((), world_folders=world_folders), report)
    if body is None or not body.has_root:
        return None
    if not body.root.children:
        return _empty(path)
    spans = {node.id: node.span for node, _ in body.nodes()}
    findings: list[Finding] = []
    try:
        data = lower_body(body)
        resolve_files(data, FileSearch(path.parent, world_folders))
        scene, limit_notes = clamp_scene(Scene.of_data(data))
        spec, notes = build_spec(scene)
        place_cameras(scene, spec)
        add_lighting(spec)
        model = compiled(spec, findings)
    except SceneError as error:
        report.add(codes.MODEL_FILE, _named(str(error), spans, body.root.span), str(error))
        return None
    for note in limit_notes + notes:
        report.add(codes.MODEL_SIMPLIFIED, _named(note, spans, body.root.span), note)
    for finding in findings:
        report.add(code_of(finding), _named(str(finding), spans, body.root.span), finding.message)
    return Subject(path.stem, model, {})


def _empty(path: Path) -> Subject:
    spec = new_world()
    add_lighting(spec)
    return Subject(path.stem, spec.compile(), {})


def _named(message: str, spans: dict[str, Span], otherwise: Span) -> Span:
    """The tag of the first node whose id a message contains."""
    found = next((spans[name] for name in message.split("`")[1::2] if name in spans), otherwise)
    line = found.source.text.find("\n", found.start, found.end)
    return found.source.span(found.start, found.end if line < 0 else line)
