"""The nodes of a running world: their poses, and changes at run time.

In: a simulation whose lock is held. Out: poses in RoboComp's frame, or a changed scene. A frame
without a joint is changed in the model directly; for all other changes the world is rebuilt with
its state (some ms, more with many meshes). Every function may raise `NodeError`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Any, Protocol

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.falling import falls
from robocomp_dsl.hardware.description.scene import ROOT, Frame, Scene
from robocomp_dsl.hardware.description.scene_edit import (
    NodeError,
    NodeErrorCode,
    frame_of,
    move_node,
    replace_frame,
    subtree,
)
from robocomp_dsl.hardware.devices.errors import require_finite
from robocomp_dsl.hardware.kinematics.rotations import Matrix, angles, inverse, pose_rows
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.world.limits import require_limits
from robocomp_dsl.simulation.world.state import SimulationState

NAMES = ("x", "y", "z", "rx", "ry", "rz")


class ChangeableWorld(Protocol):
    """A simulation, as far as changes of its nodes need it."""

    state: SimulationState

    def rebuild(self, scene: Scene, forget: Collection[str] = ()) -> None:
        """Switch to another scene; what is in both keeps its state, except `forget`."""

    def switch_to(self, branch: SimulationState) -> None:
        """Continue from another state."""


def between(state: SimulationState, base: str, item: str) -> Matrix:
    """The transform of points from the frame `item` to the frame `base`, shape (4, 4), mm."""
    for name in (base, item):
        frame_of(state.scene, name)
    relative: Matrix = inverse(state.matrix(base)) @ state.matrix(item)
    return relative


def pose_of(matrix: Matrix) -> tuple[float, ...]:
    """x, y, z, rx, ry, rz of a matrix."""
    return (*map(float, matrix[:3, 3]), *angles(matrix[:3, :3]))


def matrix_of(pose: Sequence[float]) -> Matrix:
    """The matrix of x, y, z, rx, ry, rz. Raises `CommandRefused` for NaN."""
    require_finite(**dict(zip(NAMES, pose, strict=True)))
    matrix = np.eye(4)
    matrix[:3] = pose_rows(pose)
    return matrix


def place(simulation: ChangeableWorld, base: str, item: str, pose: Sequence[float]) -> None:
    """Set the pose of the frame `item` in `base`."""
    state = simulation.state
    frame = frame_of(state.scene, item)
    if frame.id == ROOT:
        raise NodeError(NodeErrorCode.WRONG_NODE, "the root stays where it is")
    if frame.model_part:
        _place_given(
            simulation.state, frame, between(simulation.state, ROOT, base) @ matrix_of(pose)
        )
        return
    in_parent = between(simulation.state, frame.parent, base) @ matrix_of(pose)
    # as it is written, if it is relative to the parent: a joint may turn by more than 180 degrees
    x, y, z, rx, ry, rz = pose if base == frame.parent else pose_of(in_parent)
    changed = replace(frame, place=(x, y, z), turn=(rx, ry, rz))
    require_limits(Scene((changed,)))
    if frame.motion:
        _place_joint(simulation, changed)
    elif _falls(simulation.state, frame.id):
        in_root = between(simulation.state, ROOT, frame.parent) @ in_parent
        _place_body(simulation, changed, in_root)
    else:
        _place_body(simulation, changed, in_parent)


def _place_given(branch: SimulationState, frame: Frame, in_root: Matrix) -> None:
    """Move a body of a model file: `mocap` or free bodies."""
    if frame.model_part == "joint":
        message = f"`{frame.id}` is a joint of the model file: JointMotor and ControlBoard move it"
        raise NodeError(NodeErrorCode.WRONG_NODE, message)
    x, y, z, rx, ry, rz = pose_of(in_root)
    require_limits(Scene((replace(frame, place=(x, y, z), turn=(rx, ry, rz)),)))
    model, data = branch.world.model, branch.world.data
    position = axes.point(x, y, z)
    turned = axes.quaternion(in_root[:3, :3])
    body = branch.body(frame.id) if frame.model_part == "body" else 0
    joint, mocap = int(model.body_jntadr[body]), int(model.body_mocapid[body])
    if mocap >= 0:
        data.mocap_pos[mocap], data.mocap_quat[mocap] = position, turned
    elif joint >= 0 and int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_FREE):
        state = data.joint(joint)
        state.qpos[:], state.qvel[:] = [*position, *turned], 0.0
    else:
        message = (
            f"`{frame.id}` is held by the model file: only free bodies and those of `mocap` move"
        )
        raise NodeError(NodeErrorCode.WRONG_NODE, message)
    mujoco.mj_forward(model, data)


def _place_joint(simulation: ChangeableWorld, frame: Frame) -> None:
    """Reset the joint to the angle of its pose."""
    simulation.rebuild(replace_frame(simulation.state.scene, frame), forget=(frame.id,))
    simulation.state.devices[frame.id].update_frame(frame.id)


def _place_body(simulation: ChangeableWorld, frame: Frame, pose: Matrix) -> None:
    """`pose` is in the body above in MuJoCo's tree: of a falling frame, the world."""
    branch = simulation.state
    model, data = branch.world.model, branch.world.data
    body = branch.body(frame.id)
    position = axes.point(*pose[:3, 3].tolist())
    turned = axes.quaternion(pose[:3, :3])
    branch.scene = replace_frame(branch.scene, frame)
    model.body_pos[body], model.body_quat[body] = position, turned
    first = int(model.body_jntadr[body])
    for joint in range(first, first + int(model.body_jntnum[body])):
        state = data.joint(joint)
        state.qvel[:] = 0.0
        free = model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
        state.qpos[:] = [*position, *turned] if free else 0.0
    mujoco.mj_forward(model, data)
    device: Any = branch.devices.get(frame.id)
    if device is not None and hasattr(device, "update_frame"):
        device.update_frame(frame.id)
    simulation.switch_to(branch)


def move(simulation: ChangeableWorld, item: str, parent: str) -> None:
    """Move a node to another parent; its present local pose is unchanged, also if it fell there."""
    scene, forget = simulation.state.scene, []
    if any(frame.id == item for frame in scene.frames) and _falls(simulation.state, item):
        frame = frame_of(scene, item)
        x, y, z, rx, ry, rz = pose_of(between(simulation.state, frame.parent, item))
        scene = replace_frame(scene, replace(frame, place=(x, y, z), turn=(rx, ry, rz)))
        forget = [item]
    simulation.rebuild(move_node(scene, item, parent), forget)


def _falls(state: SimulationState, id: str) -> bool:
    frames = {frame.id: frame for frame in state.scene.frames}
    return falls(frames[id], frames)


def touching(state: SimulationState, first: str, other: str) -> bool:
    """Whether a shape in one subtree touches or penetrates one in the other."""
    left, right = (_geoms(state, node) for node in (first, other))
    model, data = state.world.model, state.world.data
    if not len(left) or not len(right):
        return False
    apart = np.linalg.norm(data.geom_xpos[left][:, None] - data.geom_xpos[right][None], axis=2)
    reach = model.geom_rbound[left][:, None] + model.geom_rbound[right][None]
    for i, j in np.argwhere(apart <= reach):
        a, b = int(left[i]), int(right[j])
        if a != b and mujoco.mj_geomDistance(model, data, a, b, 1e-6, None) <= 0:
            return True
    return False


def _geoms(state: SimulationState, id: str) -> Any:
    below = subtree(state.scene, id)
    model = state.world.model
    frames = (frame for frame in state.scene.frames if frame.model_part in {"", "body"})
    bodies = {state.body(frame.id) for frame in frames if frame.id in below}
    chosen = [
        geom
        for geom in range(model.ngeom)
        if int(model.geom_bodyid[geom]) in bodies or model.geom(geom).name in below
    ]
    return np.array(chosen, dtype=np.int64)
