"""What `rcgen view` looks at: a file in InnerModel, URDF or MJCF, or a robot that ships.

In: what the user named. Out: a compiled model, and findings with their places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco

from robocomp_dsl.check import check_innermodel
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli.model_findings import code_of, read_source, tell, tell_faults
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes_model as codes
from robocomp_dsl.generate.scene import lower
from robocomp_dsl.generate.scene_files import locate
from robocomp_dsl.hardware.errors import SceneError
from robocomp_dsl.hardware.findings import Finding, ModelFileError
from robocomp_dsl.hardware.model_kind import MODELS, outermost
from robocomp_dsl.hardware.mujoco.model_file import compiled, read_spec
from robocomp_dsl.hardware.mujoco.scene_limits import fitting
from robocomp_dsl.hardware.mujoco.scene_spec import build_spec
from robocomp_dsl.hardware.robots.build import add_robot, new_world
from robocomp_dsl.hardware.robots.catalog import ROBOTS
from robocomp_dsl.hardware.scene import Scene
from robocomp_dsl.hardware.view.picture import lit
from robocomp_dsl.source import Source, Span


@dataclass(frozen=True, slots=True)
class Subject:
    """`start` is what the joints have at first, by name, where that is not 0.

    A model file starts at the first of its key frames.
    """

    name: str
    model: Any
    start: dict[str, float]

    def data(self) -> Any:
        """Its state at the start."""
        data = mujoco.MjData(self.model)
        if self.model.nkey:
            mujoco.mj_resetDataKeyframe(self.model, data, 0)
        for name, value in self.start.items():
            data.joint(name).qpos = value
        mujoco.mj_forward(self.model, data)
        return data


def read_subject(path: Path, packages: Sequence[Path], report: Report) -> Subject | None:
    """The model that `path` names; None after errors that leave nothing to look at."""
    if not path.exists() and str(path) in ROBOTS:
        return _robot(str(path))
    try:
        data = path.read_bytes()
    except OSError as error:
        said = f"`{path}` cannot be read: {error.strerror or error}"
        report.add(codes.MODEL_FILE, Source(path, "").whole, said)
        return None
    if outermost(data) in MODELS:
        return _model(path, packages, report)
    return _world(path, report)


def _robot(name: str) -> Subject:
    robot = ROBOTS[name]()
    spec = new_world()
    add_robot(spec, robot)
    lit(spec)
    return Subject(name, spec.compile(), dict(robot.start))


def _model(path: Path, packages: Sequence[Path], report: Report) -> Subject | None:
    source = read_source(path)
    try:
        spec, findings = read_spec(path, packages)
        lit(spec)
        model = compiled(spec, findings)
    except ModelFileError as error:
        tell_faults(error, source, report)
        return None
    tell(findings, source, report)
    return Subject(path.stem, model, {})


def _world(path: Path, report: Report) -> Subject | None:
    """A world is shown as far as it is understood: its errors are told, and it is there."""
    body = check_innermodel(path, Workspace(()), report)
    if body is None or not body.found:
        return None
    if not body.root.children:
        return _empty(path)
    spans = {node.id: node.span for node, _ in body.nodes()}
    findings: list[Finding] = []
    try:
        data = lower(body)
        locate(data, path.parent)
        scene, told = fitting(Scene.of_data(data))
        spec, notes = build_spec(scene)
        lit(spec)
        model = compiled(spec, findings)
    except SceneError as error:
        report.add(codes.MODEL_FILE, _named(str(error), spans, body.root.span), str(error))
        return None
    for note in told + notes:
        report.add(codes.MODEL_SIMPLIFIED, _named(note, spans, body.root.span), note)
    for one in findings:
        report.add(code_of(one), _named(str(one), spans, body.root.span), one.said)
    return Subject(path.stem, model, {})


def _empty(path: Path) -> Subject:
    spec = new_world()
    lit(spec)
    return Subject(path.stem, spec.compile(), {})


def _named(said: str, spans: dict[str, Span], otherwise: Span) -> Span:
    """The tag of the node whose id a message names first."""
    found = next((spans[name] for name in said.split("`")[1::2] if name in spans), otherwise)
    line = found.source.text.find("\n", found.start, found.end)
    return found.source.span(found.start, found.end if line < 0 else line)
