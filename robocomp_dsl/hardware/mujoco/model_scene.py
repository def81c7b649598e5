"""A model file as the data of a scene: what is in it, and what of it can be served.

In: the path of a file in MJCF or URDF. Out: the data for `hardware.scene.Scene`, as JSON holds
them, and findings. The frames are those of `mirror`: bodies, joints and marks; the devices are
joints with motors, cameras, inertial units, touch sensors and range finders.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.hardware.findings import Finding
from robocomp_dsl.hardware.mujoco.mirror import Mirror, mirror
from robocomp_dsl.hardware.mujoco.model_file import compiled
from robocomp_dsl.hardware.mujoco.model_hands import hands_of
from robocomp_dsl.hardware.mujoco.model_joints import couplings_of, joints_of
from robocomp_dsl.hardware.mujoco.model_motors import others, through_tendons
from robocomp_dsl.hardware.mujoco.model_sensors import sensors_of
from robocomp_dsl.hardware.mujoco.model_start import Started, begin
from robocomp_dsl.hardware.mujoco.model_transmissions import transmissions_of
from robocomp_dsl.hardware.scene import ROOT

Data = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Described:
    """`scene` holds `file` as the name of its model; `step` is the length of a step in s."""

    scene: Data
    findings: list[Finding]
    step: float


def describe(path: Path, file: str, packages: Sequence[Path] = ()) -> Described:
    """The scene of the model at `path`, which will be called `file`.

    Raises `ModelFileError`, `OSError`.
    """
    started = begin(path, packages)
    model = compiled(started.spec, started.findings)
    seen = mirror(model)
    devices = joints_of(model, seen, started)
    couplings = couplings_of(model, devices, started.findings)
    transmissions = transmissions_of(model, devices, started.findings)
    devices += sensors_of(model, seen, {one["id"] for one in devices} | set(_names(seen)))
    devices += hands_of(model, seen, devices, started.findings)
    scene: Data = {
        "model": _model(model, file, started)
        | ({"couplings": couplings} if couplings else {})
        | ({"transmissions": transmissions} if transmissions else {}),
        "frames": list(_frames(seen)),
        "boxes": [],
        "meshes": [],
        "devices": devices,
    }
    findings = [one for one in started.findings if one.kind != "overlap"]  # it may start elsewhere
    return Described(scene, findings, float(model.opt.timestep))


def _model(model: Any, file: str, started: Started) -> Data:
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
    return data | {name: given for name, given in more if given}


def _names(seen: Mirror) -> list[str]:
    return [name for name in seen.tree if name != ROOT]


def _frames(seen: Mirror) -> list[Data]:
    """All frames of the model, each after its parent; the root is the world's own."""
    joints = {one.frame for one in seen.joints}
    bodies = set(seen.bodies)
    made: list[Data] = [{"id": ROOT, "parent": ""}]
    for name in _names(seen):
        given = "body" if name in bodies else "joint" if name in joints else "mark"
        made.append({"id": name, "parent": seen.tree.parent(name), "given": given})
    return made
