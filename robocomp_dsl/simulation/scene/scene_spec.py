"""A scene as a MuJoCo model: a body per frame, a joint per moving frame, a geom per shape.

In: a `Scene`. Out: an `MjSpec` whose joints and geoms have the scene's ids (bodies: `body_name`),
and notes on simplifications. Poses are those of `TransformTree`: `axes.matrix` of `xpos` and
`xmat` gives its matrices.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.falling import falls, loads
from robocomp_dsl.hardware.description.scene import (
    ROOT,
    Frame,
    Mesh,
    Model,
    Motion,
    Scene,
    Triple,
)
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.kinematics.rotations import Matrix, pose_rows, rotation
from robocomp_dsl.simulation.models.start_spec import reload_spec
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.scene.scene_shapes import add_box, add_mesh
from robocomp_dsl.simulation.world.arena import reserve_arena

_LIGHTEST = 1e-3  # kg: default mass of a moving frame
_MOST_NAMED = 4
_UNIT: dict[str, Triple] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def body_name(frame: str) -> str:
    """The body name of a frame; `world` is MuJoCo's own name for the root."""
    return {ROOT: "world", "world": "world."}.get(frame, frame)


def build_spec(scene: Scene) -> tuple[Any, list[str]]:
    """The model of `scene`, and notes on deviations from it. Raises `SceneError`."""
    spec, notes = _base_spec(scene.model)
    bodies = {body.name: body for body in spec.bodies} | {ROOT: spec.worldbody}
    degrees = math.degrees(1.0) if spec.compiler.degree else 1.0
    taken = {joint.name for joint in spec.joints} | {frame.id for frame in scene.frames}
    frames = {frame.id: frame for frame in scene.frames}
    into = _BuildContext(
        spec, bodies, frames, loads(scene.frames), degrees, scene.model is not None, taken
    )
    try:
        for frame in scene.frames:
            if frame.id != ROOT and not frame.model_part:
                bodies[frame.id] = _add_frame(into, frame, notes)
        for box in scene.boxes:
            add_box(spec, bodies[box.frame], box, notes)
        deviating: dict[str, list[Mesh]] = {}
        for mesh in scene.meshes:
            if deviation := add_mesh(spec, bodies[mesh.frame], mesh):
                deviating.setdefault(deviation, []).append(mesh)
        notes += (_mesh_note(meshes, text) for text, meshes in deviating.items())
    except ValueError as error:
        raise SceneError(f"MuJoCo cannot build the world: {error}") from None
    reserve_arena(spec, len(bodies))
    return spec, notes


def _mesh_note(meshes: list[Mesh], deviation: str) -> str:
    """One note for all meshes with the same deviation."""
    first: dict[str, str] = {}
    for mesh in meshes:
        first.setdefault(mesh.file, mesh.id)
    named = [f"`{id_}` ({Path(file).name})" for file, id_ in first.items()]
    more = f" and {len(named) - _MOST_NAMED} more" if len(named) > _MOST_NAMED else ""
    which = f"{', '.join(named[:_MOST_NAMED])}{more}"
    return (
        f"the mesh {which} is {deviation}"
        if len(named) == 1
        else (f"{len(named)} meshes, {which}, are each {deviation}")
    )


@dataclass(frozen=True, slots=True)
class _BuildContext:
    """The specification under construction. Hinge angles are multiplied by `degrees`.

    `taken` are the names of present and future joints. The weight of `loads` is not compensated.
    """

    spec: Any
    bodies: dict[str, Any]
    frames: dict[str, Frame]
    loads: frozenset[str]
    degrees: float
    weigh: bool
    taken: set[str]

    def free(self, name: str) -> str:
        """Reserve a joint name based on the requested one."""
        while name in self.taken:
            name += "'"
        self.taken.add(name)
        return name

    def in_world(self, frame: Frame) -> Matrix:
        """The pose of a frame that nothing above it moves, shape (4, 4), mm."""
        if frame.id == ROOT:
            return np.eye(4)
        if frame.model_part:
            return _pose_in_model(self.spec, frame.id)
        local = np.eye(4)
        local[:3] = pose_rows((*frame.place, *frame.turn))
        pose: Matrix = self.in_world(self.frames[frame.parent]) @ local
        return pose


def _pose_in_model(spec: Any, body: str) -> Matrix:
    """The pose of a fixed body of the model file, shape (4, 4), mm."""
    model = spec.copy().compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    at = model.body(body).id
    return axes.matrix(data.xpos[at], data.xmat[at])


def _base_spec(model: Model | None) -> tuple[Any, list[str]]:
    """The specification that the scene is added to: that of its file, or an empty one."""
    if model is None:
        spec, notes = mujoco.MjSpec(), list[str]()
        spec.compiler.degree = False
        lightest = _LIGHTEST
    else:
        try:
            started = reload_spec(model.file)
        except OSError as error:
            message = f"`{model.file}` cannot be read: {error.strerror or error}"
            raise SceneError(message) from None
        spec, notes = started.spec, [str(finding) for finding in started.findings]
        lightest = max(model.boundmass, spec.compiler.boundmass)
    spec.compiler.boundmass = lightest
    spec.compiler.boundinertia = max(lightest * 1e-3, spec.compiler.boundinertia)
    return spec, notes


def _add_frame(into: _BuildContext, frame: Frame, notes: list[str]) -> Any:
    if frame.parent not in into.bodies:
        raise SceneError(f"`{frame.id}` is in `{frame.parent}`, which is not a frame before it")
    if falls(frame, into.frames):
        return _add_falling(into, frame, notes)
    body = into.bodies[frame.parent].add_body(
        name=body_name(frame.id),
        pos=axes.point(*frame.place),
        quat=axes.quaternion(rotation(*frame.turn)),
    )
    moves = frame.motion or frame.drives or frame.physics
    if frame.mass > 0 or (moves and into.weigh):
        _weigh(body, frame.mass if frame.mass > 0 else _LIGHTEST)
    if frame.id not in into.loads:
        body.gravcomp = 1.0
    if frame.physics:
        notes.append(f"`{frame.id}` is in a frame that moves: it is carried, and does not fall")
    if frame.motion:
        _add_joint(body, frame, frame.motion, into.degrees)
    elif frame.drives:
        _add_wheels(body, frame, into)
    return body


def _add_falling(into: _BuildContext, frame: Frame, notes: list[str]) -> Any:
    """A body that starts in its frame and moves freely; MuJoCo has those in the world only."""
    pose = into.in_world(frame)
    body = into.spec.worldbody.add_body(
        name=body_name(frame.id),
        pos=axes.point(*pose[:3, 3].tolist()),
        quat=axes.quaternion(pose[:3, :3]),
    )
    if frame.mass <= 0:
        notes.append(f"`{frame.id}` falls and has no mass: it gets {_LIGHTEST:g} kg")
    if frame.mass > 0 or into.weigh:
        _weigh(body, frame.mass if frame.mass > 0 else _LIGHTEST)
    body.add_freejoint(name=frame.id)
    return body


def _weigh(body: Any, mass: float) -> None:
    body.explicitinertial = True
    body.mass = mass
    body.ipos, body.iquat = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]  # else those of pos
    body.inertia = [0.4 * mass * 0.05**2] * 3  # a ball of 5 cm; shapes have no mass here


def _add_joint(body: Any, frame: Frame, motion: Motion, degrees: float) -> None:
    hinge = motion.kind == "hinge"
    at = "xyz".index(motion.axis)
    if hinge:
        # Rx·Ry·Rz: the rotations after the joint's are between joint and body
        behind = [turn if i > at else 0.0 for i, turn in enumerate(frame.turn)]
        axis = axes.turn_axis(rotation(*behind).T @ _UNIT[motion.axis])
        now, unit = frame.turn[at], degrees
    else:
        axis = axes.direction(_UNIT[motion.axis])
        now, unit = frame.place[at] - motion.offset, MM
    joint = body.add_joint(
        name=frame.id,
        type=mujoco.mjtJoint.mjJNT_HINGE if hinge else mujoco.mjtJoint.mjJNT_SLIDE,
        axis=axis,
        ref=now * unit,
        damping=[0.1, 0, 0] if hinge else [10.0, 0, 0],
    )
    if motion.low < motion.high and math.isfinite(motion.low) and math.isfinite(motion.high):
        joint.limited = mujoco.mjtLimited.mjLIMITED_TRUE
        joint.range = [motion.low * unit, motion.high * unit]


def _add_wheels(body: Any, frame: Frame, into: _BuildContext) -> None:
    """A base slides along its initial x and z and turns about its y; it cannot fall.

    The base finds the three joints by their order in the body; other nodes may have their names.
    """
    for name, axis in (("x", (1.0, 0.0, 0.0)), ("z", (0.0, 0.0, 1.0))):
        body.add_joint(
            name=into.free(f"{frame.id}.{name}"),
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=axes.direction(axis),
        )
    body.add_joint(
        name=into.free(f"{frame.id}.alpha"),
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=axes.turn_axis(np.array(_UNIT["y"])),
    )
