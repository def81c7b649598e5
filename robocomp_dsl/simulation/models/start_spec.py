"""Loads a model file as the base of a world, to which other parts are added.

In: the path of a file in MJCF or URDF. Out: its `MjSpec`, in which every served or moving element
has a name, and its first key frame, which is removed from the spec because its numbers fit only the
original file.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import mujoco

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.simulation.models.model_file import read_spec

Numbers = Sequence[float]


@dataclass(slots=True)
class StartSpec:
    """`spec` is not compiled. The other fields are the first key frame, by names.

    `start` has the position of each joint in `qpos`, `held` the commands of motors.
    """

    spec: Any
    findings: list[Finding]
    start: dict[str, Numbers] = field(default_factory=dict)
    held: dict[str, float] = field(default_factory=dict)


def load_spec(path: Path, packages: Sequence[Path] = ()) -> StartSpec:
    """The specification in the file at `path`. Raises `ModelFileError`, `OSError`."""
    spec, findings = read_spec(path, packages)
    _name(spec)
    started = StartSpec(spec, findings)
    if len(spec.keys):
        _take(spec.keys[0], started)
    for key in list(spec.keys):
        spec.delete(key)
    return started


def reload_spec(path: Path) -> StartSpec:
    """A copy of the spec of a file that is loaded once: loading meshes takes long."""
    known = _base_spec(path, path.stat().st_mtime_ns)
    return replace(known, spec=known.spec.copy(), findings=list(known.findings))


@lru_cache(maxsize=2)
def _base_spec(path: Path, _: int) -> StartSpec:
    return load_spec(path)


def _name(spec: Any) -> None:
    """Name unnamed elements: bodies as in `model_to_transforms`, joints after their bodies."""
    _fill(spec.bodies, "body")
    taken = {joint.name for joint in spec.joints}
    for body in spec.bodies:
        for i, joint in enumerate(body.joints):
            joint.name = joint.name or _free(f"{body.name}.joint{i}", taken)
    _fill(spec.cameras, "camera")
    _fill(spec.actuators, "motor")
    _fill(spec.sensors, "sensor")


def _fill(those: Iterable[Any], what: str) -> None:
    taken = {element.name for element in those}
    for i, element in enumerate(those):
        element.name = element.name or _free(f"{what}{i}", taken)


def _free(name: str, taken: set[str]) -> str:
    free, number = name, 2
    while free in taken:
        free, number = f"{name}#{number}", number + 1
    taken.add(free)
    return free


_PLACES = {mujoco.mjtJoint.mjJNT_FREE: 7, mujoco.mjtJoint.mjJNT_BALL: 4}


def _take(key: Any, started: StartSpec) -> None:
    qpos, ctrl = [float(number) for number in key.qpos], [float(number) for number in key.ctrl]
    joints, motors = started.spec.joints, started.spec.actuators
    sizes = [_PLACES.get(joint.type, 1) for joint in joints]
    for what, numbers, needed in (("qpos", qpos, sum(sizes)), ("ctrl", ctrl, len(motors))):
        if numbers and len(numbers) != needed:
            message = (
                f"the key frame `{key.name}` has {len(numbers)} numbers in `{what}`, not {needed}"
            )
            raise ModelFileError(message)
        if not all(map(math.isfinite, numbers)):
            raise ModelFileError(f"`{what}` of the key frame `{key.name}` is not finite")
    for joint, size in zip(joints, sizes, strict=True):
        if qpos:
            started.start[joint.name], qpos = qpos[:size], qpos[size:]
    started.held |= {number.name: to for number, to in zip(motors, ctrl, strict=False) if to}
