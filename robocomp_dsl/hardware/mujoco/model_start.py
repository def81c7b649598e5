"""A model file as the beginning of a world: what else is in the world is added to it.

In: the path of a file in MJCF or URDF. Out: its `MjSpec`, in which everything that is served or
moved has a name, and the first of its key frames, taken out, since its numbers fit only the file
as it was.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import mujoco

from robocomp_dsl.hardware.findings import Finding, ModelFileError
from robocomp_dsl.hardware.mujoco.model_file import read_spec

Numbers = Sequence[float]


@dataclass(slots=True)
class Started:
    """`spec` is not compiled. The rest is the first key frame, by the names of joints and motors.

    `start` has the place of each joint in `qpos`, `held` the commands of motors.
    """

    spec: Any
    findings: list[Finding]
    start: dict[str, Numbers] = field(default_factory=dict)
    held: dict[str, float] = field(default_factory=dict)


def begin(path: Path, packages: Sequence[Path] = ()) -> Started:
    """What is in the file at `path`. Raises `ModelFileError`, `OSError`."""
    spec, findings = read_spec(path, packages)
    _name(spec)
    started = Started(spec, findings)
    if len(spec.keys):
        _take(spec.keys[0], started)
    for key in list(spec.keys):
        spec.delete(key)
    return started


def begin_again(path: Path) -> Started:
    """As `begin`, of a file that is read once: meshes take long, and worlds are built again."""
    known = _begun(path, path.stat().st_mtime_ns)
    return replace(known, spec=known.spec.copy(), findings=list(known.findings))


@lru_cache(maxsize=2)
def _begun(path: Path, _: int) -> Started:
    return begin(path)


def _name(spec: Any) -> None:
    """A name for what has none: bodies as `mirror` calls them, joints by their bodies."""
    _fill(spec.bodies, "body")
    taken = {joint.name for joint in spec.joints}
    for body in spec.bodies:
        for i, joint in enumerate(body.joints):
            joint.name = joint.name or _free(f"{body.name}.joint{i}", taken)
    _fill(spec.cameras, "camera")
    _fill(spec.actuators, "motor")
    _fill(spec.sensors, "sensor")


def _fill(those: Iterable[Any], what: str) -> None:
    taken = {one.name for one in those}
    for i, one in enumerate(those):
        one.name = one.name or _free(f"{what}{i}", taken)


def _free(wanted: str, taken: set[str]) -> str:
    made, number = wanted, 2
    while made in taken:
        made, number = f"{wanted}#{number}", number + 1
    taken.add(made)
    return made


_PLACES = {mujoco.mjtJoint.mjJNT_FREE: 7, mujoco.mjtJoint.mjJNT_BALL: 4}


def _take(key: Any, started: Started) -> None:
    qpos, ctrl = [float(one) for one in key.qpos], [float(one) for one in key.ctrl]
    joints, motors = started.spec.joints, started.spec.actuators
    sizes = [_PLACES.get(joint.type, 1) for joint in joints]
    for what, given, needed in (("qpos", qpos, sum(sizes)), ("ctrl", ctrl, len(motors))):
        if given and len(given) != needed:
            said = f"the key frame `{key.name}` has {len(given)} numbers in `{what}`, not {needed}"
            raise ModelFileError(said)
        if not all(map(math.isfinite, given)):
            raise ModelFileError(f"`{what}` of the key frame `{key.name}` is not finite")
    for joint, size in zip(joints, sizes, strict=True):
        if qpos:
            started.start[joint.name], qpos = qpos[:size], qpos[size:]
    started.held |= {one.name: to for one, to in zip(motors, ctrl, strict=False) if to}
