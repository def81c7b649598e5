"""Values of a model that MuJoCo accepts, and that are probably mistakes.

In: a loaded model. Out: findings, each about a body or a joint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import model_finding
from robocomp_dsl.hardware.description.model_kind import root_tag
from robocomp_dsl.hardware.formats.urdf import UrdfJoint, read_urdf
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.simulation.models.model_file import LoadedModel

LARGEST_SIZE = 100.0
"""m: a larger robot is probably in mm."""
SMALLEST_SIZE = 0.005
LARGEST_MASS = 2000.0
"""kg: a heavier body is probably in g."""
LONGEST_GYRATION = 3.0
"""Largest radius of gyration [m] of a body, as a multiple of its size, at least 1 m."""
_TURNS = 4 * math.pi
_HINGE, _SLIDE = int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)
_LISTED = 5


def unlikely_values(loaded: LoadedModel, path: Path) -> list[Finding]:
    """The findings of the model in the file at `path`."""
    model = loaded.model
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return [
        *_ranges(loaded),
        *_names(model),
        *_sizes(model, data),
        *_masses(model),
        *_key_frames(model),
        *_motors(path),
    ]


def _ranges(loaded: LoadedModel) -> Iterator[Finding]:
    """Ranges of rotating joints in the other unit."""
    model = loaded.model
    hinges = [j for j in _single_joints(model) if int(model.jnt_type[j]) == _HINGE]
    limited = [j for j in hinges if model.jnt_limited[j]]
    for joint in _single_joints(model):
        low, high = map(float, model.jnt_range[joint])
        if low > high:
            name = model.joint(joint).name
            message = f"the range of `{name}` is {low:.4g} to {high:.4g}, so it is not limited"
            yield _about_joint(name, message)
    for joint in limited:
        low, high = map(float, model.jnt_range[joint])
        if max(abs(low), abs(high)) > _TURNS:
            name = model.joint(joint).name
            message = f"the range of `{name}` is {low:.4g} to {high:.4g} rad: is it in degrees?"
            yield _about_joint(name, message)
    if not loaded.spec.compiler.degree:
        return
    narrow = [j for j in limited if np.degrees(np.abs(model.jnt_range[j]).max()) <= 2 * math.pi]
    if narrow and len(narrow) == len(limited):
        first = model.joint(narrow[0]).name
        low, high = np.degrees(model.jnt_range[narrow[0]])
        message = (
            f"the range of `{first}` is only {low:.3g} to {high:.3g} degrees, and no joint has a"
            ' wider one: is `<compiler angle="radian"/>` missing?'
        )
        yield _about_joint(first, message)


def _names(model: Any) -> Iterator[Finding]:
    for joint in _single_joints(model):
        if not model.joint(joint).name:
            body = model.body(int(model.jnt_bodyid[joint])).name
            message = f"a joint of `{body}` has no name: no board and no description can use it"
            yield model_finding("unlikely", body, message)


def _sizes(model: Any, data: Any) -> Iterator[Finding]:
    """The largest distance between parts of one robot."""
    for root in range(1, model.nbody):
        if int(model.body_parentid[root]) != 0:
            continue
        geoms = [g for g in range(model.ngeom) if _root(model, g) == root]
        if not geoms:
            continue
        reach = model.geom_rbound[geoms][:, None]
        low = (data.geom_xpos[geoms] - reach).min(axis=0)
        high = (data.geom_xpos[geoms] + reach).max(axis=0)
        size = float((high - low).max())
        name = model.body(root).name
        if size > LARGEST_SIZE:
            message = f"`{name}` and what it carries are {size:.3g} m large: are lengths in mm?"
            yield model_finding("unlikely", name, message)
        elif 0.0 < size < SMALLEST_SIZE:
            message = f"`{name}` and what it carries are only {1000 * size:.2g} mm large"
            yield model_finding("unlikely", name, message)


def _masses(model: Any) -> Iterator[Finding]:
    for body in range(1, model.nbody):
        mass, name = float(model.body_mass[body]), model.body(body).name
        if mass > LARGEST_MASS:
            message = f"`{name}` weighs {mass:.4g} kg: is its mass in g?"
            yield model_finding("unlikely", name, message)
        elif mass > 0.0:
            gyration = math.sqrt(float(model.body_inertia[body].max()) / mass)
            geoms = np.flatnonzero(model.geom_bodyid == body)
            size = max([1.0, *(2 * model.geom_rbound[geoms])])
            if gyration > LONGEST_GYRATION * size:
                message = (
                    f"the inertia of `{name}` is that of a body of {gyration:.3g} m:"
                    " it must be in kg m²"
                )
                yield model_finding("unlikely", name, message)


def _key_frames(model: Any) -> Iterator[Finding]:
    for key in range(model.nkey):
        for joint in _single_joints(model):
            if not model.jnt_limited[joint]:
                continue
            value = float(model.key_qpos[key][model.jnt_qposadr[joint]])
            low, high = map(float, model.jnt_range[joint])
            if not low - 1e-3 <= value <= high + 1e-3:
                name, frame = model.joint(joint).name, model.key(key).name or str(key)
                message = (
                    f"the key frame `{frame}` has `{name}` at {value:.4g}, outside its limits"
                    f" {low:.4g} to {high:.4g}"
                )
                yield _about_joint(name, message)


def _motors(path: Path) -> Iterator[Finding]:
    """Joints of a URDF without a maximum effort or velocity: they cannot be driven."""
    data = read_bytes(path)
    if root_tag(data) != "robot":
        return
    joints = [joint for _, joint in read_urdf(data).links if joint and not joint.leader]
    driven = [j for j in joints if j.kind in ("revolute", "continuous", "prismatic")]
    yield from _without("effort", [j for j in driven if j.effort <= 0.0])
    yield from _without("velocity", [j for j in driven if j.speed <= 0.0])


def _without(attribute: str, joints: Sequence[UrdfJoint]) -> Iterator[Finding]:
    if joints:
        names = ", ".join(f"`{joint.name}`" for joint in joints[:_LISTED])
        more = f" and {len(joints) - _LISTED} more" if len(joints) > _LISTED else ""
        message = f"no `{attribute}` in the `<limit>` of {names}{more}"
        yield model_finding("unlikely", joints[0].name, message, joints[0].line)


def _about_joint(name: str, message: str) -> Finding:
    return model_finding("range", name, message)


def _single_joints(model: Any) -> list[int]:
    """The joints that rotate about or move along one axis."""
    return [j for j in range(model.njnt) if int(model.jnt_type[j]) in (_HINGE, _SLIDE)]


def _root(model: Any, geom: int) -> int:
    return int(model.body_rootid[model.geom_bodyid[geom]])
