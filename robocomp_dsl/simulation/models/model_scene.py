"""A model file as scene data: its content, and the devices that can be served.

In: the path of a file in MJCF or URDF. Out: the data for `hardware.description.scene.Scene` in JSON
types, and findings. The frames are those of `model_to_transforms`: bodies, joints and marks; the
devices are joints with motors, cameras, inertial units, touch sensors and range finders.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.scene import ROOT
from robocomp_dsl.simulation.models.model_end_effectors import end_effectors_of
from robocomp_dsl.simulation.models.model_file import compiled
from robocomp_dsl.simulation.models.model_joints import couplings_of, joints_of
from robocomp_dsl.simulation.models.model_motors import others, through_tendons
from robocomp_dsl.simulation.models.model_sensors import sensors_of
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms, model_transforms
from robocomp_dsl.simulation.models.model_transmissions import transmissions_of
from robocomp_dsl.simulation.models.start_spec import StartSpec, load_spec

Data = dict[str, Any]


@dataclass(frozen=True, slots=True)
class ModelDescription:
    """`scene` contains `file` as the name of its model; `step` is the physics time step in s."""

    scene: Data
    findings: list[Finding]
    step: float


def describe(path: Path, file: str, packages: Sequence[Path] = ()) -> ModelDescription:
    """The scene of the model at `path`, which is stored under the name `file`.

    Raises `ModelFileError`, `OSError`.
    """
    started = load_spec(path, packages)
    model = compiled(started.spec, started.findings)
    seen = model_transforms(model)
    devices = joints_of(model, seen, started)
    couplings = couplings_of(model, devices, started.findings)
    transmissions = transmissions_of(model, devices, started.findings)
    devices += sensors_of(model, seen, {device["id"] for device in devices} | set(_names(seen)))
    devices += end_effectors_of(model, seen, devices, started.findings)
    scene: Data = {
        "model": _model(model, file, started)
        | ({"couplings": couplings} if couplings else {})
        | ({"transmissions": transmissions} if transmissions else {}),
        "frames": list(_frames(seen)),
        "boxes": [],
        "meshes": [],
        "devices": devices,
    }
    findings = [
        device for device in started.findings if device.kind != "overlap"
    ]  # its start may differ
    return ModelDescription(scene, findings, float(model.opt.timestep))


def _model(model: Any, file: str, started: StartSpec) -> Data:
    data: Data = {"file": file}
    if bound := float(started.spec.compiler.boundmass):
        data["boundmass"] = bound
    start = {
        joint: places
        for joint, places in started.start.items()
        if list(places) != list(model.joint(joint).qpos0)
    }
    held = {name: started.held[name] for name in others(model) if name in started.held}
    more = (("start", start), ("held", held), ("pulled", through_tendons(model)))
    return data | {name: value for name, value in more if value}


def _names(seen: ModelTransforms) -> list[str]:
    return [name for name in seen.tree if name != ROOT]


def _frames(seen: ModelTransforms) -> list[Data]:
    """All frames of the model, parents first; the root is the world's own."""
    joints = {joint.frame for joint in seen.joints}
    bodies = set(seen.bodies)
    frames: list[Data] = [{"id": ROOT, "parent": ""}]
    for name in _names(seen):
        origin = "body" if name in bodies else "joint" if name in joints else "mark"
        frames.append({"id": name, "parent": seen.tree.parent(name), "model_part": origin})
    return frames
